// Follows a run in a browser from its beginning to its replay: pauses it, steps it, and resumes it. Prints each problem
// as a line; prints nothing if all is well.
// usage: node watch.mjs WEB CHROMIUM DOOR RUN
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, lookAt, openTab} from '../report/browser.mjs';
import {addsUp, letGo, lossesOf, openRun, pausedByItself, sleep, stateOf, until, waitUntil} from './page.mjs';

const [web, chromium, door, run] = process.argv.slice(2);
const {browser, page, complaints, host} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);
const kStep = 20;  // ticks per exchange

const begins = await pausedByItself(page);
expect(begins.tick === 0, `the run paused at tick ${begins.tick}`);
await letGo(page);
await until(page, ({tick}) => tick > 0, 'the run flies');
await page.click('#pause');
const held = await until(page, ({state}) => state === 'paused', 'the run is paused');
const before = await page.screenshot({encoding: 'base64'});
await sleep(1500);
const still = await stateOf(page);
expect(still.tick === held.tick, `while it is paused the tick went from ${held.tick} to ${still.tick}`);
for (let step = 1; step <= 3; ++step) {
  await page.keyboard.press('s');
  const after = await until(page, ({tick}) => tick !== held.tick + kStep * (step - 1), 'a step');
  expect(after.tick === held.tick + kStep * step, `step ${step} went from ${held.tick} to ${after.tick}`);
}
await sleep(500);
expect((await stateOf(page)).tick === held.tick + 3 * kStep, 'the run continued after a step');

// The page shows the attainable score with the next step after the oracle has computed it.
const losses = await waitUntil(async () => {
  await page.keyboard.press('s');
  await sleep(200);
  return lossesOf(page);
}, () => true, 'losses are told');
expect(losses?.when === 'so far' && addsUp(losses), `the page shows the losses ${JSON.stringify(losses)}`);
const stepped = await stateOf(page);
// The picture is taken while the run is paused. The page reloads when the run ends, and Chromium never answers a
// request for a picture of a page that reloads meanwhile.
expect(await page.screenshot({encoding: 'base64'}) !== before, 'the picture has not changed');

// The keyboard alone resumes the run, and the chosen speed takes effect.
await page.select('#speed', 'max');
await page.keyboard.press('Escape');
await page.evaluate(() => document.activeElement.blur());
await page.keyboard.press('p');
const later = await until(page, ({tick, state}) => state !== 'paused' && tick > stepped.tick + 200 * kStep,
    'the run continues');
expect(later.events > 0, 'the page shows no event');

await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'its replay');
const replay = await stateOf(page);
const result = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
expect(replay.score === result.score, `the score is ${replay.score}, but ${result.score} in result.json`);
expect(replay.shown === result.score.toFixed(3), `the score shown is ${replay.shown}`);
expect(result.score > 0, 'nothing was scored: that proves little');
const lost = await lossesOf(page);
expect(lost?.rows['attainable, by estimate'][0] === result.attainable.points && addsUp(lost) && lost.when.startsWith('at the end'),
       `in the end it tells ${JSON.stringify(lost)} of losses`);
const picture = await lookAt(browser, await page.screenshot({encoding: 'base64'}));
expect(picture.colours > 100 && picture.largest < 0.9, `the page is blank: ${JSON.stringify(picture)}`);
// A browser without the key does not see the run.
const stranger = await openTab(await browser.createBrowserContext());
await stranger.goto(`http://${host}/`, {waitUntil: 'load'});
expect(await stranger.$('#flight') === null, 'a browser without the key sees the run');
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
