// Requests LiDAR points and a map on the page of a live run, ends the request, and requests the map in the replay.
// Prints each problem as a line; prints nothing if all is well.
// usage: node clouds.mjs WEB CHROMIUM DOOR RUN
import {endBrowser, lookAt} from '../report/browser.mjs';
import {letGo, openRun, pausedByItself, sleep, until, waitUntil} from './page.mjs';

const [web, chromium, door] = process.argv.slice(2);
const {browser, page, complaints} = await openRun([web, chromium, door]);
const expect = (good, what) => good || console.log(what);
const kMostBytes = 20000;  // mean size of one UAV's points, or of a map, in a message

/** Statistics of the messages that the page receives on its WebSocket. */
const told = {scene: null, frames: 0, clouds: 0, bytes: 0, since: 0, names: new Map(), newest: new Map(), points: []};
const spy = await page.createCDPSession();
await spy.send('Network.enable');
spy.on('Network.webSocketFrameReceived', ({response}) => {
  const message = JSON.parse(response.payloadData);
  told.scene = message.scene ?? told.scene;
  ++told.frames;
  ++told.since;
  if (!message.clouds) return;
  ++told.clouds;
  told.since = 0;
  told.bytes += response.payloadData.length;
  for (const cloud of message.clouds) {
    told.names.set(cloud.n, (told.names.get(cloud.n) ?? 0) + 1);
    told.newest.set(cloud.n, cloud);
    for (const {points} of cloud.steps ?? []) {
      if (points === undefined) continue;
      const bytes = Buffer.from(points, 'base64');
      for (let i = 0; i + 6 <= bytes.length; i += 6)
        told.points.push([0, 2, 4].map((at) => bytes.readInt16LE(i + at) / 10));
    }
  }
});
const eventually = (holds, what) => waitUntil(
    async () => ({holds: await holds(), told: [...told.names]}), (now) => now.holds, what);
const note = () => page.$eval('#clouds-note', (element) => element.textContent);
const choose = (id, value) => page.select(`#${id}`, value);
const press = (id) => page.evaluate((name) => document.getElementById(name).click(), id);
const stage = async () => {
  await sleep(300);  // until the browser has drawn the next picture
  const png = await (await page.$('.stage')).screenshot({encoding: 'base64'});
  const figures = await lookAt(browser, png);
  await page.bringToFront();
  return {png, ...figures};
};
const count = (kind) => [...told.names].reduce((sum, [name, times]) => sum + (name.startsWith(kind) ? times : 0), 0);

await page.reload();  // so that the spy sees all messages
await pausedByItself(page);
await letGo(page);
await eventually(() => told.frames > 30, 'news of the flight');
expect(told.clouds === 0, 'points or maps were sent although no viewer requested them');
expect(await note() === '', `the page says ${await note()} although no viewer requested points or maps`);

await choose('speed', '0.5');  // so that the run does not end before the checks
await choose('lidar-of', 'all');
await choose('map-of', 'jurong');
await eventually(() => count('lidar') >= 10 && told.points.length > 1500, 'LiDAR points');
await eventually(() => (told.newest.get('map jurong')?.steps?.[0].runs.length ?? 0) > 2000, 'a map of some size');
expect(told.names.has('lidar jurong') && told.names.has('lidar raffles'), 'not all explorers have points');
expect(![...told.names.keys()].some((name) => /sentosa|map raffles/.test(name)),
    'points or maps were sent that no viewer requested');
// A mean, because a busy machine may join messages.
const each = told.bytes / [...told.names.values()].reduce((sum, times) => sum + times, 0);
expect(each < kMostBytes, `points or a map have ${each} bytes`);
expect(told.newest.get('map jurong').kind === 'what it flies on', 'the map is not the one that the UAV flies on');
expect(told.newest.get('map jurong').free.length > 100, 'the map shows no free space at the UAV\'s height');

// LiDAR points are near the structure, of which the page knows the interest points.
const near = (() => {
  const kCell = 1.5;
  const cells = new Map();
  const key = (p) => p.map((v) => Math.floor(v / kCell)).join();
  const {points} = told.scene;
  for (let i = 0; i < points.length; i += 9) {
    const p = [points[i] / 100, points[i + 1] / 100, points[i + 2] / 100];
    cells.set(key(p), [...(cells.get(key(p)) ?? []), p]);
  }
  return (p) => {
    for (let i = 0; i < 27; ++i) {
      const shifted = [i % 3, Math.floor(i / 3) % 3, Math.floor(i / 9)].map((v, axis) => p[axis] + (v - 1) * kCell);
      for (const q of cells.get(key(shifted)) ?? [])
        if (Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < kCell) return true;
    }
    return false;
  };
})();
const share = told.points.filter(near).length / told.points.length;
expect(share > 0.6, `${share} of the LiDAR points are beside the points of the structure`);
const beside = told.points.filter(([x, y, z]) => near([x + 6, y - 6, z + 6])).length / told.points.length;
expect(beside < share / 2,
    `even if the points are shifted, ${beside} of them are beside the structure: that proves little`);

// Each choice changes the picture. The run is paused, so that nothing else changes it.
await press('pause');
await until(page, ({state}) => state === 'paused', 'the run is paused');
await sleep(1500);  // for messages that were sent before the pause
expect(/LiDAR points, the newest of .* jurong: what it flies on/.test(await note()), `the page says ${await note()}`);
const both = await stage();
await choose('clouds-by', 'uav');
const byUav = await stage();
await press('map-free');
const noFree = await stage();
await choose('map-of', '');
const points = await stage();
await choose('lidar-of', '');
const none = await stage();
const pictures = {both, byUav, noFree, points, none};
for (const [one, {png}] of Object.entries(pictures))
  for (const [other, {png: second}] of Object.entries(pictures))
    if (one < other) expect(png !== second, `the pictures ${one} and ${other} are the same`);
expect(both.colours > none.colours, 'points and map add no colour');

// The server sends nothing more when the user ends the request, nor when the page no longer renews it.
await letGo(page);
await eventually(() => told.since > 20, 'an end of points and maps');
await choose('lidar-of', 'all');
await eventually(() => told.since === 0, 'points again');
await page.evaluate(() => {
  for (let timer = 0; timer < 100000; ++timer) clearInterval(timer);
});
await eventually(() => told.since > 60, 'an end of the lease');

await choose('speed', 'max');
await until(page, ({state, live}) => state === 'replay' && live === 'yes', 'its replay');
await sleep(500);
expect(await page.$eval('#lidar-of', (element) => element.disabled),
    'LiDAR points are offered although the recording has none');
const before = await stage();
await choose('map-of', 'jurong');
await eventually(async () => /jurong: /.test(await note()), 'the map in the replay');
const after = await stage();
expect(before.png !== after.png, 'the map of the replay is not visible');
for (const complaint of complaints) console.log(complaint);
await endBrowser(browser);
