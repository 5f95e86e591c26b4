// diff_odiff.mjs BASELINE CURRENT OUT: all images of two folders by one server of odiff.
import fs from 'node:fs';
import path from 'node:path';
import { ODiffServer } from 'odiff-bin';

const [baseline, current, out] = process.argv.slice(2);
const server = new ODiffServer();
for (const name of fs.readdirSync(baseline))
  await server.compare(path.join(baseline, name), path.join(current, name), path.join(out, name));
server.stop();
