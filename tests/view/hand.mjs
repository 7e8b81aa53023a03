// Flies a UAV by hand from the page of a run, then kills the browser while a key is pressed. Prints each problem as a
// line; prints nothing if all is well. With PICTURES, writes pictures for people into this folder.
// usage: node hand.mjs WEB CHROMIUM DOOR UAV [PICTURES]
import {letGo, openRun, pausedByItself, sleep, until, waitUntil} from './page.mjs';

const [web, chromium, door, uav, pictures] = process.argv.slice(2);
const {browser, page, complaints} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);

const hand = () => page.evaluate(() => ({
  wanted: document.getElementById('wanted').textContent,
  title: document.querySelector('#hand h2').textContent,
  held: document.getElementById('held').textContent,
  facts: Object.fromEntries(
      [...document.querySelectorAll('#chosen dt')].map((name) => [name.textContent, name.nextElementSibling.textContent])),
  chosen: document.querySelector('#chosen h2').textContent,
}));
const position = async () => (await hand()).facts.position.split(',').map(Number.parseFloat);
const wait = (holds, what) => waitUntil(hand, holds, what);
const shoot = (name) => pictures && page.screenshot({path: `${pictures}/${name}.png`});

await pausedByItself(page);
await letGo(page);
// Before the user takes the controls, keys have no effect.
await page.keyboard.down('w');
await sleep(700);
expect((await hand()).wanted === 'rest', 'a key has an effect before the user has taken the controls');
await page.keyboard.up('w');

await page.click('#take');
const taken = await wait(({title}) => title === `You fly ${uav}`, 'the controls are taken');
expect(taken.chosen === uav, `the page follows ${taken.chosen}`);
await page.keyboard.down('r');
await wait(({wanted}) => wanted.startsWith('up'), 'the key commands the UAV to climb');
await wait(({facts}) => Number.parseFloat(facts.position.split(',')[2]) > 6, 'the UAV climbs');
await page.keyboard.up('r');
await wait(({wanted}) => wanted === 'rest', 'the key is up');
const top = await position();

// Two keys at once, and a page that loses the focus while they are pressed. The UAV first flies straight on, because a
// UAV that turns while it accelerates from rest flies a circle and gets no farther than 2.5 m from its place.
const away = ({facts}) => {
  const [x, y] = facts.position.split(',').map(Number.parseFloat);
  return Math.hypot(x - top[0], y - top[1]);
};
await page.keyboard.down('w');
await wait((now) => away(now) > 1, 'the UAV flies ahead');
await page.keyboard.down('q');
await wait(({wanted}) => wanted.includes('ahead') && wanted.includes('turn left'), 'the UAV flies ahead and turns');
await shoot('flying');
await wait((now) => away(now) > 3, 'the UAV is 3 m from there');
await page.evaluate(() => dispatchEvent(new Event('blur')));
await wait(({wanted}) => wanted === 'rest', 'the UAV rests while the page has no focus');
await page.keyboard.up('w');
await page.keyboard.up('q');

// Arrow keys fly the UAV at the speed of the slider. Keys pressed in an input field do not.
await page.evaluate(() => {
  const speed = document.getElementById('hand-speed');
  speed.value = '1';
  speed.dispatchEvent(new Event('input'));
});
await page.keyboard.down('ArrowLeft');
await wait(({wanted}) => wanted === 'left 1.0 m/s', 'the UAV flies left at the speed of the slider');
await page.keyboard.up('ArrowLeft');
await wait(({wanted}) => wanted === 'rest', 'the UAV rests when the arrow key is released');
await page.keyboard.press('Escape');
await wait(({title}) => title === `Fly ${uav} by hand`, 'Escape gives up the controls');
await page.keyboard.down('d');
await sleep(700);
expect((await hand()).wanted === 'rest', 'a key has an effect after the user has let go of the controls');
await page.keyboard.up('d');

// A gamepad with the standard mapping.
await page.evaluate(() => {
  const pad = {connected: true, mapping: 'standard', axes: [0, 0, 0.05, -1], buttons: []};
  Object.defineProperty(navigator, 'getGamepads', {configurable: true, value: () => [pad]});
});
await page.click('#take');
await wait(({wanted}) => wanted === 'ahead 1.0 m/s', 'a stick flies the UAV, except within its dead zone');
await page.evaluate(() => Object.defineProperty(navigator, 'getGamepads', {configurable: true, value: () => []}));
await wait(({wanted}) => wanted === 'rest', 'the UAV rests when the stick is released');

await page.select('#speed', '8');
await page.evaluate(() => document.activeElement.blur());
await page.keyboard.down('d');
await wait(({wanted}) => wanted === 'right 1.0 m/s', 'the UAV flies to the right');
for (const complaint of complaints) console.log(complaint);
// The browser dies without closing the connection.
browser.process().kill('SIGKILL');
