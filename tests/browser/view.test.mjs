// The page of `curveflow view` in a browser, opened from a file.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn, frameShown, illegible, inColour, keptPage, launch, ofTheCurve, open, pageOf, pixels, textsOf } from "./support.mjs";

const TRACE = "#traces canvas";
let browser, threeFold;

before(async () => {
  browser = await launch();
  threeFold = pageOf("three_fold");
});
after(() => browser?.close());

/** A test with an open page, which must not complain. */
function onPage(name, path, body, options = {}) {
  test(name, async () => {
    const { page, complaints } = await open(browser, path(), options);
    await body(page);
    assert.deepEqual(complaints, []);
    await page.close();
  });
}

/** Which of the canvases look different after `action`. */
async function changes(page, action) {
  const canvases = ["#curve", "#history", TRACE];
  const before = [];
  for (const canvas of canvases) before.push(await pixels(page, canvas));
  await action();
  const changed = [];
  for (const [k, canvas] of canvases.entries()) if (await pixels(page, canvas) !== before[k]) changed.push(canvas);
  return changed;
}

onPage("the slider moves everything", () => threeFold, async (page) => {
  assert.deepEqual(await changes(page, () => page.locator("#slider").fill("90")), ["#curve", "#history", TRACE]);
  assert.equal(await frameShown(page), 91);
  assert.deepEqual(await changes(page, () => drawn(page)), [], "drawing again changes nothing");
});

onPage("the curve is coloured by every field", () => threeFold, async (page) => {
  await page.locator("#slider").fill("90");
  const names = await page.locator("#field option").allTextContents();
  assert.deepEqual(names, ["protein density ρ", "curvature κ", "normal velocity V", "metric g"]);
  const looks = new Set();
  for (const name of names) {
    await page.locator("#field").selectOption({ label: name });
    looks.add(await pixels(page, "#curve"));
  }
  assert.equal(looks.size, names.length);
  assert.deepEqual(await changes(page, () => page.locator("#ranges").selectOption("frame")), ["#curve", TRACE]);
});

onPage("space plays and pauses", () => threeFold, async (page) => {
  const start = await frameShown(page);
  const changed = await changes(page, async () => {
    await page.keyboard.press("Space");
    await page.waitForFunction(() => Number(document.getElementById("slider").value) >= 5);
    assert.equal(await page.locator("#play").getAttribute("aria-label"), "pause");
    await page.keyboard.press("Space");
  });
  assert.deepEqual(changed, ["#curve", "#history", TRACE]);
  const stopped = await frameShown(page);
  assert.ok(stopped > start);
  await page.waitForTimeout(300);
  assert.equal(await frameShown(page), stopped);
});

onPage("playing ends at the last frame, and starts again from the first", () => threeFold, async (page) => {
  const last = Number(await page.locator("#slider").getAttribute("max"));
  await page.locator("#speed").selectOption("4");
  await page.locator("#slider").fill(String(last - 3));
  await page.locator("#play").click();
  await page.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "play");
  assert.equal(await frameShown(page), last + 1);
  await page.locator("#play").click();
  assert.ok(await frameShown(page) < last);
});

onPage("arrows, Home and End choose a frame", () => threeFold, async (page) => {
  const last = Number(await page.locator("#slider").getAttribute("max")) + 1;
  const expected = [["ArrowRight", 2], ["ArrowRight", 3], ["ArrowLeft", 2], ["Shift+ArrowRight", 12], ["End", last],
    ["ArrowRight", last], ["Home", 1], ["ArrowLeft", 1]];
  for (const focus of [null, "#slider", "#play"]) {
    if (focus) await page.locator(focus).focus();
    for (const [key, frame] of expected) {
      await page.keyboard.press(key);
      assert.equal(await frameShown(page), frame, `${key} with ${focus} in focus`);
    }
  }
});

/** Where the curve is: the middle of its canvas, moved left until a node is near. */
async function pointAtCurve(page) {
  const box = await page.locator("#curve").boundingBox();
  for (let x = 0.42; x > 0.1; x -= 0.02) {
    const at = { x: box.x + x * box.width, y: box.y + 0.47 * box.height };
    await page.mouse.move(at.x, at.y);
    await drawn(page);
    if (await page.locator("#tip").isVisible()) return { box, at };
  }
  throw new Error("no node found");
}

onPage("a point of the curve shows its values and is marked in the trace", () => threeFold, async (page) => {
  await page.keyboard.press("End");
  let box, at;
  assert.deepEqual(await changes(page, async () => { ({ box, at } = await pointAtCurve(page)); }), ["#curve", TRACE]);
  const text = await page.locator("#tip").textContent();
  for (const name of ["node ", "s = ", "position", "protein density ρ", "curvature κ", "metric g"]) assert.ok(text.includes(name), text);
  const tip = await page.locator("#tip").boundingBox();
  assert.ok(at.x < tip.x || at.x > tip.x + tip.width || at.y < tip.y || at.y > tip.y + tip.height, "the node is covered");
  const away = () => page.mouse.move(box.x + 5, box.y + 5);
  await away();
  await drawn(page);
  assert.ok(await page.locator("#tip").isHidden());
  await pointAtCurve(page);
  await page.mouse.down();
  await page.mouse.up();
  await away();
  await drawn(page);
  assert.ok(await page.locator("#tip").isVisible(), "a click keeps it");
});

onPage("energy over time: linear and logarithmic, and a click goes to its time", () => threeFold, async (page) => {
  assert.ok(await page.locator("#log-time").isChecked());
  assert.deepEqual(await changes(page, () => page.locator("#log-time").uncheck()), ["#history"]);
  const box = await page.locator("#history").boundingBox();
  await page.mouse.click(box.x + 0.95 * box.width, box.y + 0.5 * box.height);
  assert.equal(await frameShown(page), Number(await page.locator("#slider").getAttribute("max")) + 1);
});

onPage("the numbers of the run are there", () => threeFold, async (page) => {
  const text = await page.locator("#tables").textContent();
  for (const name of ["largest rise of the energy over a step0", "mass of protein", "gap at closure", "stopped because",
    "Krylov iterations", "∫ dissipation"]) assert.ok(text.includes(name), name);
  await page.locator("summary").first().click();
  assert.ok((await page.locator("#scene").textContent()).includes("[energy.agents]"));
});

for (const [scene, traces] of [["blend", ["curved density ρ", "flat density ρ"]], ["length_penalty", ["parameter s"]]]) {
  test(`${scene} has its traces`, async () => {
    const { page, complaints } = await open(browser, pageOf(scene));
    const labels = await page.locator(TRACE).evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    assert.deepEqual(labels, traces.map((name) => `curvature over ${name}`));
    assert.deepEqual(complaints, []);
    await page.close();
  });
}

test("fields of the scene can be chosen", async () => {
  const { page, complaints } = await open(browser, pageOf("incompressible", ["--set", 'output.fields=["tangential-velocity"]']));
  await page.locator("#field").selectOption({ label: "tangential_velocity" });
  await drawn(page);
  assert.ok((await page.locator("#curve").getAttribute("aria-label")).endsWith("coloured by tangential_velocity"));
  assert.deepEqual(complaints, []);
  await page.close();
});

for (const width of [320, 390, 700, 1600]) {
  for (const colorScheme of ["light", "dark"]) {
    onPage(`${width} pixels, ${colorScheme}: nothing sticks out`, () => threeFold, async (page) => {
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
      const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      assert.equal(back === "rgb(255, 255, 255)", colorScheme === "light");
    }, { viewport: { width, height: 800 }, colorScheme });
  }
}

onPage("hostile texts are shown, not obeyed", () => keptPage("hostile"), async (page) => {
  assert.equal(await page.locator("script").count(), 7);
  const start = "</title></script><!--<script>alert(1)</script>";
  assert.ok((await page.title()).startsWith(start));
  for (const id of ["#title", "#scene", "#resolved-scene"]) assert.ok((await page.locator(id).textContent()).startsWith(start), id);
  assert.ok((await page.locator("#tables").textContent()).includes(`mass of ${start}`));
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
});

for (const name of ["near", "far", "units", "late"]) {
  for (const width of [390, 1280]) {
    onPage(`${name}, ${width} pixels: labels are whole and apart`, () => keptPage(name), async (page) => {
      for (const key of ["Home", "End"]) {
        await page.keyboard.press(key);
        assert.deepEqual(await illegible(page), []);
      }
    }, { viewport: { width, height: 900 } });
  }
}

onPage("a curve far from the origin is drawn as any other, and says where it is", () => keptPage("far"), async (page) => {
  await page.keyboard.press("End");
  const texts = await textsOf(page, "#curve");
  assert.ok(texts.includes("x − 1048576") || texts.some((text) => /^x − 10485\d\d$/.test(text)), texts.join("; "));
  await pointAtCurve(page);
  const text = await page.locator("#tip").textContent();
  const position = text.match(/position([\d.]+), ([\d.]+)curvature/);
  assert.ok(position, text);
  for (const value of position.slice(1)) assert.ok(Math.abs(Number(value) - 1048576) < 5, text);
});

test("few nodes are drawn round, and as many far from the origin as near it", async () => {
  const counts = [];
  for (const name of ["near", "far"]) {
    const { page } = await open(browser, keptPage(name));
    // Beside the curve nothing differs but its labels.
    await page.evaluate(() => { CanvasRenderingContext2D.prototype.lineTo = new Proxy(CanvasRenderingContext2D.prototype.lineTo, {
      apply(lineTo, pen, at) { if (pen.canvas.id === "curve") window.sides = (window.sides ?? 0) + 1; return Reflect.apply(lineTo, pen, at); },
    }); });
    await page.keyboard.press("End");
    await drawn(page);
    counts.push(await page.evaluate(() => window.sides));
    await page.close();
  }
  assert.ok(counts[0] > 3 * 256, `${counts}`);
  assert.equal(counts[0], counts[1]);
});

onPage("no line leads from the start to a late frame in log time", () => keptPage("late"), async (page) => {
  const [energy, length] = [[0, 114, 178], [213, 94, 0]];
  const early = (colour) => inColour(page, "#history", colour, 0.25, 0.7);
  assert.ok(await early(energy) > 100, "the steps have energies early");
  assert.equal(await early(length), 0, "nobody knows the length there");
  assert.ok(await page.locator("#at-start").isVisible());
  await page.locator("#log-time").uncheck();
  assert.ok(await early(length) > 100);
  assert.ok(await page.locator("#at-start").isHidden());
}, { colorScheme: "light" });

onPage("what is not a number is a gap", () => keptPage("gaps"), async (page) => {
  const whole = await ofTheCurve(page);
  await page.keyboard.press("ArrowRight");
  const left = await ofTheCurve(page);
  // A quarter has no position, another no density.
  assert.ok(left > 0.4 * whole && left < 0.6 * whole, `${left} of ${whole} pixels`);
});

onPage("one frame is shown, with nothing to play", () => keptPage("one-frame"), async (page) => {
  assert.equal(await frameShown(page), 1);
  assert.ok(await page.locator("#play").isDisabled() && await page.locator("#slider").isDisabled());
  for (const key of ["Space", "ArrowRight", "End"]) await page.keyboard.press(key);
  assert.equal(await frameShown(page), 1);
  assert.ok(await ofTheCurve(page) > 1000);
});
