// Opens the self-contained page of two finished runs. Prints each problem as a line; prints nothing if all is well.
// usage: node pair.mjs WEB CHROMIUM FILE RUN_A RUN_B TIME     TIME: of the first difference [s], or "same"
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, openBrowser, openPage} from '../report/browser.mjs';
import {sleep, stateOf, until} from './page.mjs';

const [web, chromium, file, a, b, time] = process.argv.slice(2);
const expect = (good, what) => good || console.log(what);
const results = [a, b].map((run) => JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8')));
const browser = await openBrowser(web, chromium);
const {page, complaints} = await openPage(browser, file, {width: 1400, scheme: 'light'});
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
await sleep(500);

const scores = () => page.evaluate(() => ['score', 'score-b'].map((id) => Number(document.getElementById(id).dataset.exact)));
const text = (selector) => page.$eval(selector, (element) => element.textContent);
expect((await scores()).every((score, k) => score === results[k].score), `the scores are ${await scores()}, not ${results.map(({score}) => score)}`);
const rows = await page.$$eval('#fleet tbody tr', (all) => all.map(
    (row) => [row.querySelector('button').textContent, ...[...row.cells].slice(1).map((cell) => cell.textContent)]));
results.forEach((result, k) => result.uavs.forEach(({name}) => {
  const row = rows.find(([first]) => first === `${'AB'[k]} ${name}`);
  const share = result.score_by_uav[name] ?? 0;
  expect(row !== undefined && Math.abs(Number(row.at(-1)) - share) < 0.006, `the row of ${'AB'[k]} ${name} is ${row}, and its share ${share}`);
}));
const note = await text('#pair');
if (time === 'same') {
  expect(note.includes('the same, step by step'), `for runs that are the same, the page says ${note}`);
  expect(await page.$('.first-difference') === null, 'a difference is marked between runs that are the same');
} else {
  expect(note.includes(`First difference at ${Number(time).toFixed(2)} s`),
      `for a difference at ${time} s, the page says ${note}`);
  const mark = await page.$eval('.first-difference', (element) => Number(element.style.getPropertyValue('--at')));
  const end = Math.max(...results.map(({sim_time_s: s}) => s));
  expect(Math.abs(mark - Number(time) / end) < 1e-3, `the mark is at ${mark} of the slider`);
  await page.click('#difference');
  await sleep(300);
  expect(await text('#clock') === `${Number(time).toFixed(1)} s`,
      `a click on the mark leads to ${await text('#clock')}`);
  await page.focus('#moment');
  await page.keyboard.press('End');
}

// The pictures without A and without B differ from that of both, and from each other.
const stage = async () => (await page.$('.stage')).screenshot({encoding: 'base64'});
const pictures = [await stage()];
for (const run of ['A', 'B']) {
  await page.click(`[data-run="${run}"]`);
  await sleep(300);
  pictures.push(await stage());
  await page.click(`[data-run="${run}"]`);
}
expect(new Set(pictures).size === 3, `of the three pictures of both, B and A, only ${new Set(pictures).size} differ`);
await sleep(300);
expect(await stage() === pictures[0], 'A and B do not come back');
await page.select('#points-of', '1');
await sleep(300);
expect((await stage() !== pictures[0]) === (time !== 'same'),
    'the points of B look like those of A although they differ, or differ although they are the same');
for (const complaint of complaints) expect(false, complaint);
await endBrowser(browser);
