// The page of a run in a browser, opened as a user opens it, and what it complains of as it goes on.
import {readFileSync} from 'node:fs';

import {openBrowser, openTab, sleep, waitUntil} from '../report/browser.mjs';

export {sleep, waitUntil};

/** @param known  a browser that is open already. @param webgl  false: as one that has none. @returns browser, page, complaints, and the page's host. */
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

/** What the page says; null while it is loaded anew. */
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

/** Waits until a fact holds. @returns what the page says then. */
export const until = (page, holds, what) => waitUntil(() => stateOf(page), holds, what);

/** Waits for a run that pauses by itself (--pause-at): however slow the browser was, it is not over yet. */
export const pausedByItself = (page) =>
  until(page, ({state, live}) => state === 'paused' && live === 'yes', 'it pauses by itself');

/** Lets a paused run go on. */
export async function letGo(page) {
  await page.click('#pause');
  return until(page, ({state}) => state === 'flies', 'it goes on');
}

/** Where a point of the scene is on the screen, by the page's own means: the pointer tells of it. */
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

/** What the page tells of losses: by row of its table points and score; null while it tells nothing. */
export const lossesOf = (page) => page.$eval('#losses', (panel) => (panel.hidden ? null : {
  when: panel.querySelector('thead th').textContent,
  rows: Object.fromEntries([...panel.querySelectorAll('tbody tr:not([hidden])')].map((row) => [
    row.cells[0].textContent, [Number(row.cells[1].textContent), Number(row.cells[2].textContent)]])),
}));

/** Whether what could be had, less what is lost, is what was delivered: as shown, so to a tenth a row. */
export function addsUp({rows}) {
  const {'could be had, by estimate': [, could], delivered: [, delivered], ...lost} = rows;
  const losses = Object.values(lost);
  return Math.abs(could + losses.reduce((sum, [, score]) => sum + score, 0) - delivered) <= 0.05 * (losses.length + 2) + 1e-9;
}
