// Checks a UAV's map over time on the page of a finished run: the map grows when the slider moves, and is at each
// moment the newest snapshot. Prints each problem as a line; prints nothing if all is well.
// usage: node maps.mjs WEB CHROMIUM PAGE RUN   (PAGE: a door, or a page in a file)
import {readFileSync} from 'node:fs';

import {unpackedRuns} from '../../web/src/packed.js';
import {endBrowser, openBrowser, openPage} from '../report/browser.mjs';
import {openRun, sleep, until, waitUntil} from './page.mjs';

const [web, chromium, file, run] = process.argv.slice(2);
const expect = (good, what) => good || console.log(what);
const isServed = /\/enter"/.test(readFileSync(file, 'utf8'));
const kUav = 'jurong';

const told = {map: null};
const spyOn = async (page) => {
  const spy = await page.createCDPSession();
  await spy.send('Network.enable');
  spy.on('Network.webSocketFrameReceived', ({response}) => {
    const message = JSON.parse(response.payloadData);
    told.map = message.clouds?.find(({n}) => n === `map ${kUav}`) ?? told.map;
  });
};
const open = async () => {
  if (isServed) return openRun([web, chromium, file]);
  const browser = await openBrowser(web, chromium);
  return {browser, ...await openPage(browser, file, {width: 1400, scheme: 'light'})};
};

const {browser, page, complaints} = await open();
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'the replay');
await spyOn(page);
const note = () => page.$eval('#clouds-note', (element) => element.textContent);
const moveTo = async (seconds) => {
  await page.$eval('#moment', (slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input', {bubbles: true}));
  }, String(seconds));
  await sleep(300);
};
const stage = async () => (await page.$('.stage')).screenshot({encoding: 'base64'});

expect(await page.$eval('#clouds', (tools) => !tools.textContent.includes('--maps')),
    'the page says that the run has no maps over time');
await page.select('#map-of', kUav);
await waitUntil(note, (text) => /what it flies on/.test(text), 'a map');

const shown = [];
for (const seconds of [9.5, 12, 19.9, 20, 25, 38, 45, 52, 60]) {
  await moveTo(seconds);
  const text = await note();
  const found = new RegExp(`^${kUav}: what it flies on, of ([\\d.]+) s, (\\d+) cubes of`).exec(text);
  if (!found) {
    expect(seconds < 10, `at ${seconds} s the page says ${text}`);
    continue;
  }
  const [time, cubes] = found.slice(1).map(Number);
  expect(time <= seconds && seconds - time < 10 + 1e-6, `at ${seconds} s the map is that of ${time} s`);
  shown.push({seconds, time, cubes});
  if (!told.map) continue;
  const there = told.map.steps.filter(({t, until: end = Infinity}) => t <= seconds + 1e-6 && seconds + 1e-6 < end);
  const lengths = there.flatMap(({runs}) => unpackedRuns(runs).filter((_, i) => i % 4 === 3));
  const count = lengths.reduce((sum, length) => sum + length, 0);
  expect(cubes === count, `at ${seconds} s there are ${cubes} cubes instead of ${count}`);
}
expect(!isServed || told.map !== null, 'no map was sent to the page');
expect(new Set(shown.map(({time}) => time)).size >= 4, `there are too few maps: ${JSON.stringify(shown)}`);
const cubes = shown.map((one) => one.cubes);
expect(cubes.at(-1) > 1.5 * cubes[0] && cubes[0] > 0, `the map does not grow: ${cubes}`);

// The map is visible.
await moveTo(45);
const withMap = await stage();
await page.select('#map-of', '');
await sleep(300);
const without = await stage();
expect(withMap !== without, 'the map is not visible');
await page.select('#map-of', kUav);
await sleep(300);
expect(await stage() === withMap, 'the map looks different when it is chosen again');
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
