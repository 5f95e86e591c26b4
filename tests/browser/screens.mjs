// screens.mjs FOLDER: screenshots of the report as PNG files, and in made-by.txt the browser and
// the fonts that made them: only screenshots of the same browser and fonts can be compared.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { drawingsNear, openingPlaced } from "./waits.mjs";

const folder = process.argv[2];
mkdirSync(folder, { recursive: true });
const browser = await chromium.launch({
  executablePath: process.env.MAPPROOF_CHROMIUM,
  args: ["--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--font-render-hinting=none"],
});
const report = pathToFileURL(join(process.env.MAPPROOF_REPORT, "report.html")).href;

async function take(name, options, prepare = () => {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 1000 }, ...options });
  const page = await context.newPage();
  await page.goto(report);
  await openingPlaced(page);
  await page.evaluate(() => Promise.all(Array.from(document.images, (image) => image.decode())));
  await page.locator("select.method").waitFor({ state: "attached" });  // Made when there is time.
  // Its date and commit are those of the run.
  await page.evaluate(() => { document.querySelector(".made").textContent = "Made by mapproof."; });
  await prepare(page);
  await page.evaluate(() => document.fonts.ready);
  await page.screenshot({ path: join(folder, `${name}.png`), animations: "disabled" });
  await context.close();
}

async function showMap(page) {
  const map = page.locator("#figure-map-bearing-isomap");
  await map.evaluate((figure) => unfold(figure));
  await map.scrollIntoViewIfNeeded();
  await map.locator("svg").waitFor();
  await map.evaluate((figure) => figure.scrollIntoView({ block: "start" }));
  await drawingsNear(page);
  await map.getByRole("combobox").selectOption({ label: "L10" });
}

const showTable = (page) => page.locator("#section-accuracy-bearing, section:has(.table)").first()
  .evaluate((section) => section.scrollIntoView({ block: "start" }));

await take("wide", {});
await take("dark", { colorScheme: "dark" }, showTable);
await take("landmark", {}, showMap);
await take("phone", { viewport: { width: 390, height: 844 } });
// As on A4, with 180 mm between the margins.
await take("print", { viewport: { width: 680, height: 990 } }, async (page) => {
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
});
const fonts = execFileSync("fc-match", ["system-ui", "family", "file"]).toString().trim();
writeFileSync(join(folder, "made-by.txt"), `Chromium ${browser.version()}\n${fonts}\n`);
await browser.close();
