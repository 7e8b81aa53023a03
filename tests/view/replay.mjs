// Opens the replay of a finished run: light and dark, wide and narrow, with mouse and keyboard.
// Prints each problem as a line; prints nothing if all is well.
// usage: node replay.mjs WEB CHROMIUM DOOR RUN
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, lookAt} from '../report/browser.mjs';
import {findPoint, openRun, sleep, stateOf, until} from './page.mjs';

const [web, chromium, door, run] = process.argv.slice(2);
let where = '';
const expect = (good, what) => good || console.log(`${where}: ${what}`);
const result = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
const rows = (name) => {
  const [head, ...lines] = readFileSync(path.join(run, name), 'utf8').trim().split('\n').map((line) => line.split(','));
  return lines.map((cells) => Object.fromEntries(head.map((key, i) => [key, cells[i]])));
};
/** @returns figures of a picture. Brings the page back to the front, because a page behind lookAt()'s draws nothing. */
const look = async (browser, page, png) => {
  const figures = await lookAt(browser, png);
  await page.bringToFront();
  return figures;
};
const picture = async (browser, page) => {
  const png = await (await page.$('.stage')).screenshot({encoding: 'base64'});
  return {png, ...await look(browser, page, png)};
};

async function checkPoint(page) {
  const found = await findPoint(page, / · delivered · /);
  if (found === null) return expect(false, 'the pointer finds no delivered point');
  await page.mouse.click(...found.at);
  const shown = await page.$eval('#chosen', (element) => element.textContent);
  const best = rows('captures.csv').filter((row) => Number(row.point) === found.index && row.delivered_at_s !== '')
                   .sort((a, b) => Number(b.q) - Number(a.q))[0];
  expect(best !== undefined, `captures.csv has no delivered capture of point ${found.index}`);
  for (const word of [`Point ${found.index}`, Number(best?.q).toFixed(3), best?.uav])
    expect(shown.includes(word), `the page shows ${shown} for point ${found.index}, without ${word}`);
}

async function checkSlider(page, browser) {
  const end = await picture(browser, page);
  await page.focus('#moment');
  await page.keyboard.press('Home');
  await sleep(300);
  const begin = await picture(browser, page);
  expect(begin.png !== end.png, 'the pictures of the begin and the end are the same');
  expect((await stateOf(page)).score === 0, 'there is a score at the begin');
  await page.keyboard.press('End');
  await sleep(300);
  expect((await stateOf(page)).score === result.score, 'the score of the end is not the result\'s');
}

/** A user can reach a UAV with the Tab key alone; the view then follows this UAV. */
async function checkKeyboard(page) {
  await page.evaluate(() => document.activeElement.blur());
  for (let presses = 0; presses < 60; ++presses) {
    await page.keyboard.press('Tab');
    if (await page.evaluate(() => document.activeElement.closest('#fleet') !== null)) break;
  }
  await page.keyboard.press('Enter');
  const name = await page.$eval('#chosen h2', (element) => element.textContent);
  expect(result.uavs.some((uav) => uav.name === name), `the keyboard chose '${name}'`);
  await page.keyboard.press('Escape');
  expect(await page.$eval('#chosen', (element) => element.hidden), 'Escape does not end the choice of a UAV');
}

/** Score by UAV, from the station's captures.csv. */
const counted = {};
for (const {uav, q, reason} of rows('captures.csv'))
  if (reason === '' && Number(q) >= 0.2) counted[uav] = (counted[uav] ?? 0) + Number(q);
let browser = null;
for (const [width, scheme] of [[1400, 'light'], [1400, 'dark'], [800, 'light'], [390, 'dark']]) {
  where = `${width} ${scheme}`;
  const opened = await openRun([web, chromium, door], {width, scheme}, browser);
  const {page, complaints} = opened;
  browser = opened.browser;
  await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
  await sleep(500);
  const {score, shown} = await stateOf(page);
  expect(score === result.score && shown === result.score.toFixed(3), `the score is ${shown}, not ${result.score}`);
  const whole = await look(browser, page, await page.screenshot({encoding: 'base64'}));
  expect(scheme === 'dark' ? whole.brightness < 0.4 : whole.brightness > 0.6,
      `the page has a brightness of ${whole.brightness}`);
  const stage = await picture(browser, page);
  expect(stage.colours > 60 && stage.largest < 0.97, `the scene is blank: ${JSON.stringify({...stage, png: ''})}`);
  const tooWide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(tooWide <= 0, `the page is ${tooWide} pixels too wide`);
  await checkSlider(page, browser);
  const shares = await page.$$eval('#fleet tbody tr', (all) => all.map((row) => Number(row.lastChild.textContent)));
  result.uavs.forEach(({name}, i) => expect(Math.abs(shares[i] - (counted[name] ?? 0)) < 0.006,
      `of the score ${counted[name]} is ${name}'s, and the page says ${shares[i]}`));
  if (width === 1400) {
    await checkKeyboard(page);
    await checkPoint(page);
  }
  for (const complaint of complaints) expect(false, complaint);
  await page.close();
}
where = 'without WebGL';
const {page, complaints} = await openRun([web, chromium, door], {webgl: false}, browser);
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
await page.focus('#moment');
await page.keyboard.press('Home');
await sleep(300);
expect((await stateOf(page)).score === 0, 'the slider does not move to the begin');
expect(await page.$('#fleet tbody tr') !== null, 'the fleet is missing');
for (const complaint of complaints) expect(false, complaint);
await endBrowser(browser);
