// Opens report.html of results folders in a browser, without and with the script, light and dark, on narrow and wide
// screens. Prints each problem as a line; prints nothing if all is well.
// usage: node look.mjs WEB CHROMIUM SKEIN BUNDLE FOLDER...
import {execFileSync} from 'node:child_process';
import path from 'node:path';

import {endBrowser, lookAt, openBrowser, openPage} from './browser.mjs';
import {expectedTables, kWords, numbersOf, readRun} from './expected.mjs';

const [web, chromium, skein, bundle, ...folders] = process.argv.slice(2);
const browser = await openBrowser(web, chromium);
let where = '';
const complain = (what) => console.log(`${where}: ${what}`);
const expect = (good, what) => good || complain(what);

function compareRow(table, row, cells, expected) {
  const words = kWords[table] ?? [0];
  const shown = cells.filter((_, column) => !words.includes(column)).flatMap(numbersOf);
  const same = shown.length === expected.length && shown.every((value, i) => {
    if (value === null || expected[i] === null || expected[i] === undefined)
      return value === null && (expected[i] ?? null) === null;
    return Math.abs(value[0] - expected[i]) <= 0.5 * 10 ** -value[1] + 1e-6 * Math.max(1, Math.abs(expected[i]));
  });
  expect(same, `table ${table}, row ${row}: ${cells.join(' | ')}, but should be ${expected.join(' | ')}`);
}

/** Checks every number of every table, and the facts at the top of the page. */
async function checkNumbers(page, run) {
  const tables = await page.$$eval(
      'table[data-table]',
      (all) => all.map(
          (table) =>
              [table.dataset.table,
               [...table.tBodies[0].rows].map(
                   (row) => [...row.cells].map(
                       (cell) => [...cell.childNodes].map((node) => node.textContent).join(' ')))]));
  const shown = new Map(tables);
  for (const [name, rows] of Object.entries(expectedTables(run))) {
    if (rows === null || !shown.has(name)) {
      expect(rows === null && !shown.has(name), `table ${name} is ${rows === null ? 'shown without rows' : 'missing'}`);
      continue;
    }
    expect(
        shown.get(name).length === rows.length, `table ${name} has ${shown.get(name).length} rows, not ${rows.length}`);
    shown.get(name).forEach((cells, i) => rows[i] && compareRow(name, i, cells, rows[i]));
  }
  const score = await page.$eval('#score', (element) => element.textContent);
  expect(Math.abs(Number(score) - run.result.score) <= 0.05 + 1e-9, `the score is ${score}, not ${run.result.score}`);
  const text = await page.$eval('header', (element) => element.textContent);
  for (const fact of [run.result.digest ?? 'none', run.result.command, run.result.scenario, run.result.rules]) {
    expect(text.includes(fact), `the head of the page does not contain "${fact}"`);
  }
}

async function checkPixels(page, scheme) {
  const whole = await lookAt(browser, await page.screenshot({encoding: 'base64'}));
  expect(whole.colours > 40 && whole.largest < 0.97, `the page is blank: ${JSON.stringify(whole)}`);
  expect(
      scheme === 'dark' ? whole.brightness < 0.4 : whole.brightness > 0.6,
      `${scheme} has a brightness of ${whole.brightness}`);
}

async function checkFigures(page) {
  const figures = await page.$$eval('figure', (all) => all.map((figure) => {
    const {left, top, width, height} = figure.getBoundingClientRect();
    const title = figure.querySelector('figcaption')?.textContent ?? figure.dataset.live;
    return [title, [left + scrollX, top + scrollY, Math.max(width, 1), Math.max(height, 1)].map(Math.round)];
  }));
  const png = await page.screenshot({encoding: 'base64', fullPage: true});
  const seen = await lookAt(browser, png, figures.map(([, rectangle]) => rectangle));
  figures.forEach(([title, [, , , height]], i) => {
    expect(
        height > 60 && seen[i].colours > 8 && seen[i].largest < 0.995,
        `figure '${title}' is blank: ${JSON.stringify(seen[i])}`);
  });
}

/**
 * Checks what the script adds: charts and 3D view are drawn, the slider moves the fleet, colours and layers have
 * effects.
 */
async function checkLive(page, run) {
  expect(await page.$('body[data-live="yes"]'), 'the script has not finished');
  expect((await page.$$('.live-chart canvas')).length === 2, 'there are not two live charts');
  const stage = await page.$('.scene .stage');
  if (stage === null) return complain('there is no 3D view');
  const look = () => stage.screenshot({encoding: 'base64'});
  const before = await look();
  expect((await lookAt(browser, before)).colours > 60, 'the 3D view is blank');
  const places = () => page.$$eval('.scene .tag', (tags) => tags.map((tag) => tag.style.transform).join());
  const then = await places();
  const moveTo = (share) => page.$eval('#moment', (slider, part) => {
    slider.value = String(Number(slider.max) * part);
    slider.dispatchEvent(new Event('input'));
  }, share);
  await moveTo(0.5);  // not at the end, when UAVs hardly move: the positions of names are whole pixels
  expect((await places()) !== then, 'the slider does not move the fleet');
  await moveTo(0.97);  // late enough that there are captures
  const half = await look();
  expect(half !== before, 'the slider does not change the picture');
  await page.select('#colour-by', 'uav');
  expect((await look()) !== half || run.result.score === 0, 'the colours do not change');
  const outside = await look();
  await page.select('#follow', '0');
  const followed = await look();
  expect(followed !== outside, 'the view does not follow a UAV');
  expect(await page.$eval('#through', (box) => box.disabled) === !run.scene.cameras,
      'the choice of a camera\'s view is not enabled exactly if the result has cameras');
  if (run.scene.cameras) {
    await page.click('#through');
    expect((await look()) !== followed, 'the view is not that of the camera');
    await page.click('#through');
  }
  for (const box of await page.$$('.scene .tools input[type="checkbox"]')) await box.click();
  expect((await lookAt(browser, await look())).colours < (await lookAt(browser, half)).colours,
      'hidden layers are still drawn');
}

/** Checks that a table that is wider than the page shades its right edge until it is scrolled to its end. */
async function checkEdge(page) {
  const wide = await page.$('.wide:has(table[data-table="uavs"])');
  if (wide === null) return;
  const most = await wide.evaluate((box) => box.scrollWidth - box.clientWidth);
  expect(most > 40, 'the table of UAVs is not wider than the page');
  const edgeAt = async (left) => {
    await wide.evaluate((box, to) => box.scrollTo({left: to, behavior: 'instant'}), left);
    const {width, height} = await wide.boundingBox();
    await page.bringToFront();  // behind another tab, as after the first lookAt(), it would never be drawn
    const png = await wide.screenshot({encoding: 'base64'});
    return (await lookAt(browser, png, [[Math.floor(width) - 6, 0, 6, Math.floor(height)]]))[0].largest;
  };
  const [begin, end] = [await edgeAt(0), await edgeAt(most)];
  expect(begin < 0.4, `the right edge of the table of UAVs does not show that the table continues (${begin})`);
  expect(end > 0.5, `the right edge of the table of UAVs is still shaded at its end (${end})`);
  await wide.evaluate((box) => box.scrollTo({left: 0, behavior: 'instant'}));
}

/** @param thorough  whether to check also every figure, and all that the script adds. */
async function checkPage(folder, run, live, width, scheme, thorough) {
  where = `${path.basename(folder)}, ${live ? 'live' : 'static'}, ${width} px, ${scheme}`;
  const {page, complaints} = await openPage(browser, path.join(folder, 'report.html'), {width, scheme});
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(wide <= 0, `the page is ${wide} px too wide`);
  expect(Boolean(await page.$('#static')) !== live, 'the footer does not say how to get the interactive page');
  await checkPixels(page, scheme);
  await checkNumbers(page, run);
  if (width === 400) await checkEdge(page);
  if (thorough) await checkFigures(page);
  if (thorough && live) await checkLive(page, run);
  for (const complaint of complaints) complain(complaint);
  await page.close();
}

for (const folder of folders) {
  const run = readRun(folder);
  const all = folder === folders[0];  // the first folder is checked in all cases, others only in the two extreme ones
  for (const live of [false, true]) {
    execFileSync(skein, ['report', folder], {env: {...process.env, SKEIN_WEB: live ? bundle : 'none'}});
    for (const width of [400, 900, 1600]) {
      for (const scheme of ['light', 'dark']) {
        const extreme = (width === 400 && scheme === 'dark') || (width === 1600 && scheme === 'light');
        if (all || extreme) await checkPage(folder, run, live, width, scheme, extreme);
      }
    }
  }
}
await endBrowser(browser);
