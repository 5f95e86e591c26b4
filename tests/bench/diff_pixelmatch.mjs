// diff_pixelmatch.mjs BASELINE CURRENT OUT: all images of two folders by pixelmatch, in one process.
import fs from 'node:fs';
import path from 'node:path';
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';

const [baseline, current, out] = process.argv.slice(2);
for (const name of fs.readdirSync(baseline)) {
  const a = PNG.sync.read(fs.readFileSync(path.join(baseline, name)));
  const b = PNG.sync.read(fs.readFileSync(path.join(current, name)));
  const { width, height } = a;
  const diff = new PNG({ width, height });
  if (pixelmatch(a.data, b.data, diff.data, width, height) > 0)
    fs.writeFileSync(path.join(out, name), PNG.sync.write(diff));
}
