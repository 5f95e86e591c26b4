// time_to_interactive.mjs FILE...: prints a line "FILE MILLISECONDS" per file: the time from the
// start of loading until the page is loaded, drawn and idle; the median of three new browsers.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const kTimes = 3;

async function once(file) {
  const browser = await chromium.launch({
    executablePath: process.env.MAPPROOF_CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
  });
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: "load", timeout: 300000 });
  const idle = await page.evaluate(() => new Promise((done) => requestAnimationFrame(
    () => requestIdleCallback(() => done(performance.now())))));
  await browser.close();
  return idle;
}

for (const file of process.argv.slice(2)) {
  const times = [];
  for (let i = 0; i < kTimes; ++i) times.push(await once(file));
  console.log(file, times.sort((a, b) => a - b)[1].toFixed(0));
}
