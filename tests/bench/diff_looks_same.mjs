// diff_looks_same.mjs BASELINE CURRENT OUT: all images of two folders by looks-same, in one process.
import fs from 'node:fs';
import path from 'node:path';
import looksSame from 'looks-same';

const [baseline, current, out] = process.argv.slice(2);
for (const name of fs.readdirSync(baseline)) {
  const options = { createDiffImage: true };
  const found = await looksSame(path.join(baseline, name), path.join(current, name), options);
  if (!found.equal) await found.diffImage.save(path.join(out, name));
}
