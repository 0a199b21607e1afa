// Pages in a browser: opens them, records what they say and ask for, reads their canvases.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));

function setting(name, purpose) {
  const value = process.env[name];
  if (!value || !existsSync(value)) throw new Error(`${name} must name ${purpose}; run-tests.sh sets it, see there`);
  return value;
}

const PAGES = setting("CURVEFLOW_KEEP_PAGES", "the folder where the tests of flow-core have left their pages");

export async function launch() {
  const executablePath = setting("CURVEFLOW_BROWSER", "a program of Chromium");
  const libraries = join(dirname(executablePath), "al2023", "lib");
  const env = existsSync(libraries) ? { ...process.env, LD_LIBRARY_PATH: libraries } : process.env;
  return chromium.launch({ executablePath, env, args: ["--no-sandbox"] });
}

/** Runs a shipped scene, with options of `curveflow run`, and makes its page; returns its path. */
export function pageOf(scene, options = []) {
  mkdirSync(PAGES, { recursive: true });
  const curveflow = join(ROOT, "target", "release", "curveflow");
  const [result, page] = ["h5", "html"].map((kind) => join(PAGES, `${scene}.${kind}`));
  execFileSync(curveflow, ["run", join(ROOT, "scenes", `${scene}.toml`), "-o", result, "--replace", "-q", ...options]);
  execFileSync(curveflow, ["view", result, "-o", page, "--replace", "-q"]);
  return page;
}

/** A page that the tests of flow-core have left. */
export function keptPage(name) {
  return join(PAGES, `${name}.html`);
}

/** Keeps where every canvas has its texts since it was cleared, as boxes in its pixels. */
function spyOnTexts() {
  const { fillText, clearRect } = CanvasRenderingContext2D.prototype;
  const write = (pen, text, x, y) => {
    const { width } = pen.measureText(text);
    const left = { left: 0, center: width / 2, right: width }[pen.textAlign];
    const top = { top: 0, middle: 6, bottom: 12 }[pen.textBaseline];
    const corners = [[x - left, y - top], [x - left + width, y - top + 12]].map(([a, b]) => pen.getTransform().transformPoint({ x: a, y: b }));
    const [xs, ys] = ["x", "y"].map((axis) => corners.map((corner) => corner[axis]).sort((one, other) => one - other));
    (pen.canvas.texts ??= []).push({ text, left: xs[0], right: xs[1], top: ys[0], bottom: ys[1] });
  };
  CanvasRenderingContext2D.prototype.clearRect = function (...box) { this.canvas.texts = []; return clearRect.apply(this, box); };
  CanvasRenderingContext2D.prototype.fillText = function (...text) { write(this, ...text); return fillText.apply(this, text); };
}

/** The texts of all canvases that stick out of theirs or lie on another. */
export async function illegible(page) {
  await drawn(page);
  return page.locator("canvas").evaluateAll((all) => all.flatMap((canvas) => canvas.texts.flatMap((one, k) => {
    const out = one.left < -0.5 || one.right > canvas.width + 0.5 || one.top < -0.5 || one.bottom > canvas.height + 0.5;
    const under = canvas.texts.slice(0, k).find((other) => Math.max(one.left, other.left) < Math.min(one.right, other.right) &&
      Math.max(one.top, other.top) < Math.min(one.bottom, other.bottom));
    return out ? [`${canvas.id}: ${one.text} sticks out`] : under ? [`${canvas.id}: ${one.text} on ${under.text}`] : [];
  })));
}

/** The texts of a canvas. */
export async function textsOf(page, selector) {
  await drawn(page);
  return page.locator(selector).evaluate((canvas) => canvas.texts.map(({ text }) => text));
}

/** How many pixels of some columns of a canvas, from one part of its width to another, have nearly this colour. */
export async function inColour(page, selector, [red, green, blue], from, to) {
  const columns = await page.locator(selector).evaluate((canvas) => canvas.width);
  return over(page, selector, `(sum, data, k) => {
    const place = ((k / 4) % ${columns}) / ${columns};
    const off = Math.abs(data[k] - ${red}) + Math.abs(data[k + 1] - ${green}) + Math.abs(data[k + 2] - ${blue});
    return sum + (place > ${from} && place < ${to} && data[k + 3] > 200 && off < 60 ? 1 : 0);
  }`);
}

/** Opens a page; `complaints` fills with all that it says, asks for or pops up. */
export async function open(browser, path, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  const address = pathToFileURL(path).href;
  const complaints = [];
  await page.addInitScript(spyOnTexts);
  page.on("console", (message) => complaints.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => complaints.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => { complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on("request", (request) => {
    const url = request.url();
    if (url !== address && !url.startsWith("data:")) complaints.push(`request: ${url}`);
  });
  await page.goto(address);
  await drawn(page);
  return { page, complaints };
}

/** Waits until what was asked for is drawn: the page draws before the next picture of the screen. */
export async function drawn(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** A sum over the pixels of a canvas, of `term`: a function of all bytes and the number of the first of a pixel. */
async function over(page, selector, term) {
  await drawn(page);
  // Read from a copy: the browser warns of a canvas that is read itself.
  return page.locator(selector).first().evaluate((canvas, source) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    const add = new Function("sum", "data", "k", `return (${source})(sum, data, k)`);
    let sum = 0;
    for (let k = 0; k < data.length; k += 4) sum = add(sum, data, k);
    return sum;
  }, term.toString());
}

/** A number that changes with any pixel of a canvas. */
export async function pixels(page, selector) {
  return over(page, selector, (sum, data, k) =>
    [0, 1, 2, 3].reduce((hash, channel) => (Math.imul(hash, 31) + data[k + channel]) | 0, sum));
}

/** How many pixels of the canvas of the curve belong to it: they are in colour or, at its edge, dark. */
export async function ofTheCurve(page) {
  // The bar of colours stands in the last hundred pixels of a row.
  const columns = await page.locator("#curve").evaluate((canvas) => canvas.width);
  return over(page, "#curve", `(sum, data, k) => {
    const rgb = [data[k], data[k + 1], data[k + 2]];
    const seen = data[k + 3] > 200 && (Math.max(...rgb) - Math.min(...rgb) > 40 || Math.max(...rgb) < 80);
    return sum + (seen && (k / 4) % ${columns} < ${columns} - 100 ? 1 : 0);
  }`);
}

/** Number of the frame shown, from 1. */
export async function frameShown(page) {
  const text = await page.locator("#now").textContent();
  return Number(text.match(/^frame (\d+) of/)[1]);
}
