// Follows a run whose station is killed and restarted. Prints each problem as a line; prints nothing if all is well.
// usage: node reconnect.mjs WEB CHROMIUM DOOR RUN
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, letGo, openRun, pausedByItself, stateOf, until, waitUntil} from './page.mjs';

const [web, chromium, door, run] = process.argv.slice(2);
const {browser, page} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);
const kBack = 18 * 400;  // ticks; the station is back by then

let loads = 0;
page.on('load', () => ++loads);
await pausedByItself(page);
await letGo(page);
await until(page, ({state, tick}) => state === 'flies' && tick > kBack, 'the run flies on after the station is back');
await page.click('#pause');  // so that the run does not end before the events are read
expect(loads === 1, `the page was loaded ${loads} times`);
const told = () => page.$$eval('#events li', (all) => all.map((li) => li.textContent).join('\n'));
for (const word of ['station takes no part any more', 'jurong takes part']) {
  await waitUntil(told, (events) => events.includes(word), `the events tell that ${word}`);
}
await page.select('#speed', 'max');
await letGo(page);
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'its replay');
const {score} = await stateOf(page);
const result = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
expect(score === result.score, `the score is ${score}, but ${result.score} in result.json`);
await endBrowser(browser);
