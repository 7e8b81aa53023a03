// A browser on another machine, connected by a tunnel with another port at its near end, like that of
// `ssh -L 9000:127.0.0.1:8080 HOST`. Enters the key on the login page; then the page must follow the run. Prints each
// problem as a line.
// usage: node tunnel.mjs WEB CHROMIUM DOOR RUN
import {readFileSync} from 'node:fs';
import net from 'node:net';
import path from 'node:path';

import {endBrowser, openBrowser, openTab} from '../report/browser.mjs';
import {until} from './page.mjs';

const [web, chromium, door] = process.argv.slice(2);
const expect = (good, what) => good || console.log(what);
const far = Number(/http:\/\/127\.0\.0\.1:(\d+)\/enter/.exec(readFileSync(door, 'utf8'))[1]);
const key = readFileSync(path.join(path.dirname(door), 'view.key'), 'utf8').trim();

const tunnel = net.createServer((near) => {
  const there = net.connect(far, '127.0.0.1');
  for (const end of [near, there]) end.on('error', () => { near.destroy(); there.destroy(); });
  near.pipe(there).pipe(near);
});
await new Promise((listens) => tunnel.listen(0, '127.0.0.1', listens));
const {port} = tunnel.address();

const browser = await openBrowser(web, chromium);
for (const host of [`localhost:${port}`, `127.0.0.1:${port}`]) {
  const page = await openTab(browser);
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  await page.goto(`http://${host}/`, {waitUntil: 'load'});
  expect(await page.$('#flight') === null, `${host} shows the run to a browser without the key`);
  await page.type('input[name=key]', '0'.repeat(64));
  await page.keyboard.press('Enter');
  await page.waitForSelector('[role=alert]');
  complaints.length = 0;  // removes the complaints about the refusal
  await page.type('input[name=key]', key);
  await page.keyboard.press('Enter');
  await page.waitForSelector('#score');
  await until(page, ({state, live, tick}) => state === 'paused' && live === 'yes' && tick > 0,
      'the page follows the run');
  expect(page.url() === `http://${host}/` || page.url().startsWith(`http://${host}/#`),
      `the login led to ${page.url()}`);
  for (const complaint of complaints) console.log(complaint);
  await page.close();
}
await endBrowser(browser);
tunnel.close();
