// Follows a run in a browser. Checks that the page shows the activities that UAVs report as in activity.csv, live and
// in the replay, and that it names the UAV whose stopped program the run waits for. Prints each problem as a line.
// usage: node activity.mjs WEB CHROMIUM DOOR RUN UAV PID
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, letGo, openRun, pausedByItself, sleep, stateOf, until} from './page.mjs';

const [web, chromium, door, run, uav, pid] = process.argv.slice(2);
const {browser, page, complaints} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);
const kTicks = 400;  // per simulated second

/** @returns by UAV: activity and reason in the page's table. */
const shown = () => page.$$eval('#fleet tbody tr', (rows) => Object.fromEntries(rows.map((row) => {
  const cell = row.querySelector('.does');
  const why = cell.querySelector('.why')?.textContent ?? '';
  return [row.querySelector('button').textContent, [cell.firstChild?.textContent ?? '', why]];
})));

/** @returns activities and reasons from activity.csv at a time. @param seconds  simulated time. */
function written(seconds) {
  const [head, ...lines] = readFileSync(path.join(run, 'activity.csv'), 'utf8').trim().split('\n').map((l) => l.split(','));
  const found = {};
  for (const cells of lines) {
    const row = Object.fromEntries(head.map((key, i) => [key, cells[i]]));
    if (Number(row.time_s) > seconds + 1e-6) continue;
    const why = [row.waits_for && `waits for ${row.waits_for}`, row.no_way && `no way: ${row.no_way}`];
    found[row.uav] = [row.mode, why.filter(Boolean).join('; ')];
  }
  return found;
}

const held = await pausedByItself(page);
expect(held.tick === 12 * kTicks, `the run paused at tick ${held.tick}`);
await sleep(1000);  // lines and states do not arrive in a common order
const live = await shown();
await page.evaluate((name) => [...document.querySelectorAll('#fleet button')]
    .find((button) => button.textContent === name).click(), uav);
const facts = await page.$eval('#chosen', (element) => element.textContent);
for (const word of [live[uav][0], 'goal', 'waits for', 'ms for a simulated second'])
  expect(facts.includes(word), `the page shows '${facts}' for ${uav}, without '${word}'`);
await page.keyboard.press('Escape');

// A program that does not answer stops the run, and the page names its UAV.
await letGo(page);
process.kill(Number(pid), 'SIGSTOP');
try {
  const waits = await until(page, ({state}) => state === 'waits', `the run waits for ${uav}`);
  const text = await page.$eval('#state', (element) => element.textContent);
  expect(text === `waits for ${uav} (to answer)`, `the page says '${text}' while the run waits for ${uav}`);
  await sleep(1000);
  const still = await stateOf(page);
  expect(still.state === 'waits' && still.tick === waits.tick,
      `the run flew from tick ${waits.tick} to ${still.tick} while it waited`);
} finally {
  process.kill(Number(pid), 'SIGCONT');
}
await until(page, ({state, tick}) => state === 'flies' && tick > held.tick + kTicks, 'the run flies on');
await page.select('#speed', 'max');
await until(page, ({state, live: drawn}) => state === 'replay' && drawn === 'yes', 'its replay');
await page.$eval('#moment', (slider, seconds) => {
  slider.value = String(seconds);
  slider.dispatchEvent(new Event('input'));
}, held.tick / kTicks);
await sleep(1000);
const seconds = held.tick / kTicks;
const [replay, table] = [await shown(), written(seconds)];
for (const name of Object.keys(table)) {
  for (const [where, what] of [['live', live], ['in the replay', replay]])
    expect(JSON.stringify(what[name]) === JSON.stringify(table[name]),
           `at ${seconds} s ${name} does ${what[name]} ${where}, and ${table[name]} in activity.csv`);
}
expect(Object.keys(table).length === Object.keys(live).length, 'activity.csv has not all UAVs');
// The lanes have a colour for each activity that the UAVs reported.
const others = await page.evaluate(() => globalThis.skein.figures().otherModes);
expect(others.length === 0, `the lanes have no colour for ${others}`);
expect((await page.$$('#modes li')).length > 4, 'the lanes have no legend');
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
