// Opens the self-contained page of a finished run, as a person does who has received the file. Prints each problem as a
// line; prints nothing if all is well.
// usage: node kept.mjs WEB CHROMIUM FILE RUN
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {barsOf} from '../../web/src/steps.js';
import {endBrowser, lookAt, openBrowser, openPage} from '../report/browser.mjs';
import {addsUp, findPoint, lossesOf, sleep, stateOf, until} from './page.mjs';

const [web, chromium, file, run] = process.argv.slice(2);
const expect = (good, what) => good || console.log(what);
const result = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
const browser = await openBrowser(web, chromium);

async function checkLosses(page) {
  if (!result.losses) return expect(await lossesOf(page) === null,
      'the page shows losses although the result has none');
  const shown = await page.$eval('#losses', (panel) => panel.innerText).catch(() => '');
  for (const {points, score} of Object.values(result.losses)) {
    if (points > 0) expect(shown.includes(`${points}\t${(-score).toFixed(1)}`),
        `the losses do not show ${points} points and ${-score}: ${shown}`);
  }
  expect(shown.includes(result.attainable.score.toFixed(1)), `the losses do not show the attainable score: ${shown}`);
  await checkLossesInTime(page, await lossesOf(page));
}

/**
 * The page computes the same losses from the captures as the launcher, except below_threshold, which captures do not
 * show.
 */
async function checkLossesInTime(page, last) {
  const at = (seconds) => page.$eval('#moment', (slider, to) => {
    slider.value = String(to);
    slider.dispatchEvent(new Event('input'));
  }, seconds).then(() => sleep(600)).then(() => lossesOf(page));
  const made = await page.evaluate(() => globalThis.skein.figures().losses);
  for (const [cause, told] of Object.entries(result.losses)) {
    if (cause === 'below_threshold') continue;
    const {points, score} = cause === 'never_in_picture' ?
        {points: told.points + result.losses.below_threshold.points, score: told.score + result.losses.below_threshold.score} : told;
    const its = made[cause] ?? {points: 0, score: 0};
    expect(its.points === points && Math.abs(its.score - score) < 0.01, `${cause}: the page finds ${JSON.stringify(its)}, the launcher ${points}, ${score}`);
  }
  for (let k = 1; k < 6; ++k) {
    const then = await at((k * result.sim_time_s) / 6);
    expect(addsUp(then) && then.rows.delivered[0] <= last.rows.delivered[0], `at ${k} sixths: ${JSON.stringify(then)}`);
    const {score} = await stateOf(page);
    expect(Math.abs(then.rows.delivered[1] - score) < 0.1 + 0.005 * score, `at ${k} sixths ${then.rows.delivered[1]} is delivered, and the score is ${score}`);
  }
  const begin = await at(0);
  expect(begin.rows.delivered[0] === 0 && !begin.rows.blur, `the losses at the begin are ${JSON.stringify(begin)}`);
  await at(result.sim_time_s);
}

async function checkPoint(page) {
  const found = await findPoint(page, / · delivered · /);
  if (found === null) return expect(false, 'the pointer finds no delivered point');
  const {at, index} = found;
  await page.mouse.click(...at);
  const shown = await page.$eval('#chosen', (element) => element.textContent);
  const [head, ...lines] = readFileSync(path.join(run, 'score.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const score = Number(lines[index][head.indexOf('score')]);
  expect(shown.includes(score.toFixed(3)), `the page shows ${shown} for point ${index}, and score.csv has ${score}`);
}

const seed = Number(process.env.SKEIN_FUZZ_SEED) || (Math.random() * 2 ** 32) >>> 0;
console.error(`SKEIN_FUZZ_SEED=${seed}`);  // with this seed in the environment, the test draws the same values

/** Random numbers in [0, 1) that the seed determines (mulberry32). */
function drawsFrom(state) {
  return () => {
    state = (state + 0x6D2B79F5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
const draw = drawsFrom(seed);

/** Draws random steps: the bars have no gaps, and each step that is at least a pixel wide has a bar with its value. */
function checkBars() {
  for (let tries = 0; tries < 200; ++tries) {
    const t = Array.from({length: 30}, () => draw() ** 3 * 100).sort((a, b) => a - b);
    const v = t.map(() => Math.floor(5 * draw()));
    const bars = barsOf({t, v}, 100, (time) => time);
    expect(bars.every(([from, to], i) => from <= to && (i === 0 || from === bars[i - 1][1])), `bars have gaps: ${bars}`);
    t.forEach((begin, i) => {
      const until = t[i + 1] ?? 100;
      const bar = bars.find(([from, to]) => from <= begin && begin < to);
      if (until - begin >= 1) expect(bar?.[0] === begin && bar[1] === until && bar[2] === v[i],
          `the bar of the value ${v[i]} from ${begin} to ${until} is ${bar}`);
    });
  }
}
checkBars();

for (const [width, scheme] of [[1400, 'light'], [390, 'dark']]) {
  const {page, complaints} = await openPage(browser, file, {width, scheme});
  await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
  await sleep(500);
  const {score, shown} = await stateOf(page);
  expect(score === result.score && shown === result.score.toFixed(3), `the score is ${shown}, not ${result.score}`);
  expect(result.score > 0, 'nothing was scored: that proves little');
  const stage = async () => (await page.$('.stage')).screenshot({encoding: 'base64'});
  const end = await stage();
  const figures = await lookAt(browser, end);
  await page.bringToFront();
  expect(figures.colours > 60 && figures.largest < 0.97, `the scene is blank: ${JSON.stringify(figures)}`);
  await page.focus('#moment');
  await page.keyboard.press('Home');
  await sleep(300);
  expect((await stateOf(page)).score === 0, 'there is a score at the begin');
  expect(await stage() !== end, 'the pictures of the begin and the end are the same');
  expect((await page.evaluate(() => location.hash)).startsWith('#t=0'), 'the address does not contain the time');
  await page.keyboard.press('End');
  const tooWide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(tooWide <= 0, `the page is ${tooWide} pixels too wide`);
  if (width === 1400) await checkPoint(page);
  await sleep(600);  // the panels are drawn later than the scene
  await checkLosses(page);
  for (const complaint of complaints) expect(false, complaint);
  await page.close();
}

// An address that another user has shared.
const name = result.uavs[1].name;
const {page, complaints} = await openPage(browser, `${file}#t=20&uav=${name}&view=camera`, {width: 1400, scheme: 'light'});
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
expect(await page.$eval('#chosen h2', (element) => element.textContent) === name, 'the address does not choose its UAV');
expect((await page.$eval('#clock', (element) => element.textContent)) === '20.0 s', 'the address does not choose its time');
expect((await page.evaluate(() => location.hash)).includes('view=camera'),
    'the address no longer chooses the view of the camera');

// All parts of each picture of a film show the same moment, however fast the pictures follow each other.
const filmed = (seconds) => page.evaluate(async (at) => {
  await film.show(at);
  return document.getElementById('fleet').innerText;
}, seconds);
await page.evaluate(() => film.begin(''));
const moments = Array.from({length: 8}, (_, k) => (k + draw()) * result.sim_time_s / 8);
const fast = [];
for (const seconds of moments) fast.push(await filmed(seconds));
for (const [k, seconds] of moments.entries()) {
  const slow = await filmed(seconds);
  await sleep(600);
  const rested = await page.$eval('#fleet', (panel) => panel.innerText);
  expect(fast[k] === rested && slow === rested, `at ${seconds} s the film shows ${fast[k]}, and the page ${rested}`);
}
expect(new Set(fast).size > 4, 'nothing moves in the film');

for (const complaint of complaints)
  expect(complaint.startsWith('asks for file://'), complaint);  // the page's own address, with another fragment
await endBrowser(browser);
