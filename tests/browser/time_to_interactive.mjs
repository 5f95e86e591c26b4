// time_to_interactive.mjs FILE...: prints a line "FILE MILLISECONDS PROCESSOR_MILLISECONDS" per file:
// the time from the start of loading until the page is loaded, drawn and idle, and what the page's
// main thread took of a processor; the median of five new browsers, by time.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const kTimes = 5;

async function once(file) {
  const browser = await chromium.launch({
    executablePath: process.env.MAPPROOF_CHROMIUM,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking"],
  });
  const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: "load", timeout: 300000 });
  const idle = await page.evaluate(() => new Promise((done) => requestAnimationFrame(
    () => requestIdleCallback(() => done(performance.now())))));
  const { metrics } = await session.send("Performance.getMetrics");
  await browser.close();
  return [idle, 1000 * metrics.find(({ name }) => name === "TaskDuration").value];
}

for (const file of process.argv.slice(2)) {
  const times = [];
  for (let i = 0; i < kTimes; ++i) times.push(await once(file));
  const [idle, processor] = times.sort((a, b) => a[0] - b[0])[(kTimes - 1) / 2];
  console.log(file, idle.toFixed(0), processor.toFixed(0));
}
