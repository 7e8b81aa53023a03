// Begins and ends faults with the buttons of a run's page, with pointer and keyboard, while the run is paused and while
// it flies. Prints each problem as a line; prints nothing if all is well.
// usage: node by_hand.mjs WEB CHROMIUM DOOR RUN
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, letGo, openRun, pausedByItself, stateOf, until, waitUntil} from './page.mjs';

const [web, chromium, door, run] = process.argv.slice(2);
const {browser, page, complaints} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);

const cell = (from, to) => `#links button[data-from="${from}"][data-to="${to}"]`;
const look = (selector) => page.$eval(selector, (found) => ({
  text: found.textContent, title: found.title, kind: found.className, pressed: found.getAttribute('aria-pressed'), disabled: found.disabled,
}));
const faults = () => page.$$eval('#faults ol li', (rows) => rows.map((row) => row.textContent));
async function step() {
  const {tick} = await stateOf(page);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('s');
  await until(page, (state) => state.tick > tick, 'a step');
}

await pausedByItself(page);
await letGo(page);
await page.click('#pause');
await until(page, ({state}) => state === 'paused', 'the run is paused by the button');

// Cuts a link with the keyboard: the page marks it until the next step, then shows it as cut; the other direction
// stays.
await page.focus(cell(4, 0));
await page.keyboard.press('Enter');
await waitUntil(() => look(cell(4, 0)), ({kind}) => kind.includes('waits'), 'the cut waits for the next step');
expect((await faults()).some((text) => text.includes('begins with the next step')),
    `no fault waits for the next step: ${await faults()}`);
await step();
const cut = await waitUntil(() => look(cell(4, 0)), ({kind}) => !kind.includes('waits'), 'the link is cut');
expect(cut.title.includes('click to restore it'), `the title of the cell is ${cut.title}`);
expect(['l l2', 'l l0'].includes(cut.kind), `the class of the cell is ${cut.kind}`);  // l0: out of sight
expect((await look(cell(0, 4))).kind !== 'l l2', 'the other direction is cut, too');

// A fault that has not begun can be cancelled.
await page.click('#fleet tbody tr:nth-child(4) button');
const kill = '#uav-faults button[data-fault="kill"]';
await waitUntil(() => look(kill), ({disabled}) => !disabled, 'faults can be injected into the chosen UAV');
await page.click(kill);
await waitUntil(() => look(kill), ({text}) => text.includes('Cancel'), 'the kill waits');
expect((await look('#uav-faults button[data-fault="pause"]')).disabled,
    'the button to pause a killed program is enabled');
await page.click(kill);
await waitUntil(() => look(kill), ({pressed}) => pressed === 'false', 'the kill is cancelled');
// This time the fault begins; afterwards the program is started again.
await page.click(kill);
await waitUntil(() => look(kill), ({pressed}) => pressed === 'true', 'the kill waits again');
await step();
await step();
await waitUntil(() => look(kill), ({text}) => text.includes('Restart'), 'the program is killed');
await page.click('#uav-faults button[data-fault="camera_failure"]');
await page.click(kill);
await waitUntil(() => look(kill), ({text}) => text.includes('Kill'), 'the program starts again');
await step();
await waitUntil(faults, (texts) => texts.some((text) => /killed.*changi.*\d to \d/.test(text)), 'the kill is in the list as over');

// Ends a fault by the button in the list of faults, and begins a fault that the server refuses.
await page.$$eval('#faults ol li.on button', (buttons) => buttons.at(-1).click());  // the oldest: the link
await step();
await waitUntil(() => look(cell(4, 0)), ({title}) => title.includes('Click to cut it'), 'the link is healed');
await page.evaluate(() => document.querySelector('#uav-faults button[data-fault="motor_failure"]').click());
await waitUntil(faults, (texts) => texts.some((text) => text.includes('rotor weak')), 'a rotor is to be weak');
await page.evaluate(() => document.querySelector('#uav-faults button[data-fault="motor_failure"]').click());
await waitUntil(() => page.$eval('#faults .refused', ({textContent}) => textContent), (text) => text.includes('rotor 0 of changi has a fault'), 'the page says why it refuses');
await page.evaluate(() => document.querySelector('#faults ol li.waits button').click());
await waitUntil(faults, (texts) => !texts.some((text) => text.includes('rotor weak')), 'the rotor is left alone');

await page.evaluate(() => document.activeElement.blur());
await page.keyboard.press('p');
await until(page, ({state}) => state === 'flies', 'the run continues');
await page.$eval('#faults button[data-fault="kill"][data-of="comm_router"]', (button) => button.click());
await waitUntil(() => look('#faults button[data-fault="kill"][data-of="comm_router"]'), ({text}) => text.includes('Restart'), 'the router is killed');
await page.$eval('#faults button[data-fault="kill"][data-of="comm_router"]', (button) => button.click());
await waitUntil(() => look('#faults button[data-fault="kill"][data-of="comm_router"]'), ({text}) => text.includes('Kill'), 'the program starts again');
await page.select('#speed', 'max');

await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'its replay');
const result = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
const done = result.interventions.map(({what, kind, target}) => `${what} ${kind} ${target}`);
for (const one of ['begin link changi > gcs', 'end link changi > gcs', 'begin kill changi', 'end kill changi', 'begin camera_failure changi',
                   'begin kill comm_router', 'end kill comm_router'])
  expect(done.includes(one), `result.json does not name "${one}": ${done}`);
expect(done.length === 7, `result.json names ${done}`);
const told = await waitUntil(faults, (texts) => texts.length === 4, 'the replay lists them');
expect(await page.$('#faults button') === null, 'a replay has buttons for faults');
expect((await look(cell(4, 0))).disabled, 'a link of a replay can be cut');
expect(told.some((text) => text.includes('camera fails')), `the replay lists ${told}`);
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
