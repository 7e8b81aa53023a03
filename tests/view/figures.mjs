// Measures what the page needs to show 20 UAVs and 10,000 points: draw calls, bytes, memory over an hour. Prints a line
// for each figure beyond its bound; prints nothing if all is well. If FIGURES is in the environment, prints all figures
// to stderr.
// usage: node figures.mjs WEB CHROMIUM DOOR FEEDER
import {endBrowser, lookAt} from '../report/browser.mjs';
import {makeUp} from './made_up.mjs';
import {openRun, waitUntil} from './page.mjs';

const kPosePeriod = 0.5;        // simulated seconds between two poses of a trail
const kSpeed = 8;               // simulated seconds per second of wall time
const kStates = 1000 / 80;      // greatest number that the server sends per second (kPause of view/server.cpp)
const kPointSets = 5, kMapBytes = 20000;  // greatest rate per second, for 20 UAVs (view::look_budget())
const kMostDrawCalls = 25;     // the requirement is 50
const kMostSent = 300000;       // bytes per second
const kLeastSent = 60000;       // bytes per second; fewer would mean that the flight is not the intended one
const kMostGrowth = 1.4;        // factor of memory from ten minutes to an hour; without thinning of trails it is 2.2
const [web, chromium, door, feeder] = process.argv.slice(2);
const expect = (good, what) => good || console.log(what);
const note = (...what) => process.env.FIGURES && console.error(...what);

const flight = await makeUp(feeder, door);
const {browser, page, complaints} = await openRun([web, chromium, door]);
const devtools = await page.createCDPSession();
/**
 * Advances the flight to a simulated time, and waits until the page shows it, trails included: on a busy machine, the
 * poses arrive later than the state, which has the time.
 */
async function flyTo(seconds) {
  await flight.tell(`to ${seconds}`);
  return waitUntil(
      () => page.evaluate(() => globalThis.skein?.figures() ?? null),
      ({end, shown, trailsUntil}) => Math.min(end, shown) >= seconds - 1e-3 && trailsUntil >= seconds - kPosePeriod,
      `it shows ${seconds} s`);
}

async function memory() {
  await devtools.send('HeapProfiler.collectGarbage');
  const {usedSize, backingStorageSize = 0} = await devtools.send('Runtime.getHeapUsage');
  return usedSize + backingStorageSize;
}

/** Shows all that a page can show: the points of all UAVs, and a map. */
async function showAll() {
  await page.select('#lidar-of', 'all');
  await page.select('#map-of', 'uav00');
}

/**
 * Checks the bytes sent per second, over a part of the flight. The rate of lines depends on simulated time, that of
 * states on wall time.
 */
async function checkSent(from, until) {
  await flyTo(from);
  let [lines, largestState, messages] = [0, 0, 0];
  const largest = new Map();  // size by name of a cloud
  devtools.on('Network.webSocketFrameReceived', ({response: {payloadData}}) => {
    const {state, clouds = []} = JSON.parse(payloadData);
    const size = state === undefined ? 0 : JSON.stringify(state).length;
    lines += Buffer.byteLength(payloadData) - size;
    largestState = Math.max(largestState, size);
    for (const cloud of clouds) {
      const bytes = JSON.stringify(cloud).length;
      lines -= bytes;
      largest.set(cloud.n, Math.max(largest.get(cloud.n) ?? 0, bytes));
    }
    ++messages;
  });
  await devtools.send('Network.enable');
  await flyTo(until);
  await devtools.send('Network.disable');
  const points = [...largest].reduce((sum, [name, bytes]) => sum + (name.startsWith('lidar') ? bytes : 0), 0);
  expect(points > 5000 && largest.get('map uav00') > 5000,
      `points or map are not sent: ${JSON.stringify([...largest])}`);
  const onDemand = kPointSets * points + kMapBytes;
  const sent = (kSpeed * lines) / (until - from) + kStates * largestState + onDemand;
  note({sent, lines, largestState, messages, points, map: largest.get('map uav00')});
  expect(sent <= kMostSent, `${Math.round(sent)} bytes are sent in a second at ${kSpeed} times real time`);
  expect(sent >= kLeastSent, `only ${Math.round(sent)} bytes are sent in a second: that proves little`);
}

await showAll();
await checkSent(20, 80);
const after = {tenMinutes: await flyTo(600)};
after.tenMinutes.memory = await memory();
note(after.tenMinutes);
expect(after.tenMinutes.mostDrawCalls <= kMostDrawCalls, `a picture takes ${after.tenMinutes.mostDrawCalls} draw calls`);
expect(after.tenMinutes.trailSegments >= 20 * 1190, `the trails have ${after.tenMinutes.trailSegments} segments`);
expect(after.tenMinutes.points === 10000, `there are ${after.tenMinutes.points} points`);
const picture = async () => lookAt(browser, await (await page.$('.stage')).screenshot({encoding: 'base64'}));
const seen = await picture();
await page.bringToFront();
expect(seen.colours > 100 && seen.largest < 0.95, `the scene is blank: ${JSON.stringify(seen)}`);
after.hour = await flyTo(3600);
after.hour.memory = await memory();
note(after.hour);
expect(after.hour.mostDrawCalls <= kMostDrawCalls, `a picture takes ${after.hour.mostDrawCalls} draw calls`);
const early = after.hour.early - after.tenMinutes.early;
expect(early === 0,
    `${early} pictures were begun before the one before was finished, so the page waits for the graphics driver`);
const growth = after.hour.memory / after.tenMinutes.memory;
expect(growth <= kMostGrowth, `after an hour the page takes ${growth.toFixed(2)} times the memory of ten minutes`);
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
await flight.end();
