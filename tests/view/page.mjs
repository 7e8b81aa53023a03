// Opens the page of a run in a browser as a user does, and collects its complaints: errors, and requests to other
// hosts.
import {readFileSync} from 'node:fs';

import {endBrowser, openBrowser, openTab, sleep, waitUntil} from '../report/browser.mjs';

export {endBrowser, sleep, waitUntil};

/**
 * @param known  a browser to use; null: opens one. @param webgl  false: emulates a browser without WebGL.
 * @returns browser, page, complaints (the list grows), and the page's host with its port.
 */
export async function openRun([web, chromium, door], {width = 1400, height = 950, scheme = 'light', webgl = true} = {}, known = null) {
  const browser = known ?? await openBrowser(web, chromium);
  const page = await openTab(browser);
  const host = /http:\/\/(127\.0\.0\.1:\d+)\/enter/.exec(readFileSync(door, 'utf8'))[1];
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    const url = request.url();
    const own = [`file://${door}`, `http://${host}/`, `ws://${host}/`, 'data:', 'blob:'];
    if (!own.some((begin) => url.startsWith(begin))) complaints.push(`asks for ${url}`);
  });
  if (!webgl) {
    await page.evaluateOnNewDocument(() => {
      const {getContext} = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function(kind, ...more) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...more);
      };
    });
  }
  await page.setViewport({width, height});
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
  await page.goto(`file://${door}`, {waitUntil: 'load'});
  await page.waitForSelector('#score');
  return {browser, page, complaints, host};
}

/** @returns what the page shows; null while it reloads. */
export async function stateOf(page) {
  try {
    return await page.evaluate(() => ({
      state: document.body.dataset.state,
      live: document.body.dataset.live,
      tick: Number(document.getElementById('clock').dataset.tick),
      score: Number(document.getElementById('score').dataset.exact),
      shown: document.getElementById('score').textContent,
      events: document.querySelectorAll('#events li').length,
    }));
  } catch {
    return null;
  }
}

/** Waits until a fact holds. @returns what the page then shows. */
export const until = (page, holds, what) => waitUntil(() => stateOf(page), holds, what);

/** Waits until the run pauses by itself (--pause-at), so that it does not end before a slow browser is ready. */
export const pausedByItself = (page) =>
  until(page, ({state, live}) => state === 'paused' && live === 'yes', 'the run pauses by itself');

/** Lets a paused run go on. */
export async function letGo(page) {
  await page.click('#pause');
  return until(page, ({state}) => state === 'flies', 'the run continues');
}

/** Searches the scene with the pointer for a point whose tip matches. @returns its place on the screen; null: none. */
export async function findPoint(page, wanted) {
  const box = await (await page.$('.stage canvas')).boundingBox();
  for (let y = 0.3; y < 0.8; y += 0.02) {
    for (let x = 0.15; x < 0.85; x += 0.015) {
      const at = [box.x + x * box.width, box.y + y * box.height];
      await page.mouse.move(...at);
      const tip = await page.$eval('.tip', (element) => (element.hidden ? '' : element.textContent));
      if (wanted.test(tip)) return {at, index: Number(/point (\d+)/.exec(tip)[1]), tip};
    }
  }
  return null;
}

/** @returns the page's table of losses: points and score by row; null: it shows none. */
export const lossesOf = (page) => page.$eval('#losses', (panel) => (panel.hidden ? null : {
  when: panel.querySelector('thead th').textContent,
  rows: Object.fromEntries([...panel.querySelectorAll('tbody tr:not([hidden])')].map((row) => [
    row.cells[0].textContent, [Number(row.cells[1].textContent), Number(row.cells[2].textContent)]])),
}));

/** Whether attainable minus lost score is the delivered score, up to the rounding of each row to a tenth. */
export function addsUp({rows}) {
  const {'attainable, by estimate': [, could], delivered: [, delivered], ...lost} = rows;
  const losses = Object.values(lost);
  return Math.abs(could + losses.reduce((sum, [, score]) => sum + score, 0) - delivered) <= 0.05 * (losses.length + 2) + 1e-9;
}
