// Starts a run with --view, with or without a browser that shows it, and prints the cost of the page as a line of JSON:
// time from the first step to the first picture [ms], CPU time of scripts and of all work of the page's thread per
// picture [ms], number of pictures, largest number of draw calls. `skein bench --view` starts it. The browser is open
// before the run begins, as a user's is. Work is measured as CPU time: without a graphics card, the same cores draw.
// usage: node watched_run.mjs WEB CHROMIUM page|none RUN SKEIN ARGUMENT...
import {spawn} from 'node:child_process';
import {readFileSync} from 'node:fs';
import path from 'node:path';

import {endBrowser, openBrowser} from '../../tests/report/browser.mjs';
import {openRun, sleep, stateOf} from '../../tests/view/page.mjs';

const [web, chromium, who, run, ...command] = process.argv.slice(2);
const browser = who === 'page' ? await openBrowser(web, chromium) : null;
const begun = performance.now();
const skein = spawn(command[0], command.slice(1), {stdio: ['ignore', 'ignore', 'pipe']});
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => skein.kill(signal));
let said = '';
let over = false;
const ended = new Promise((resolve) => skein.on('exit', (code) => resolve([over = true, code][1])));
skein.stderr.on('data', (text) => (said += text));

async function look() {
  while (!/open (\S+)/.test(said) && !over) await sleep(10);
  if (over) return {};
  const {page} = await openRun([web, chromium, /open (\S+)/.exec(said)[1]], {}, browser);
  const devtools = await page.createCDPSession();
  await devtools.send('Performance.enable', {timeDomain: 'threadTicks'});
  const metrics = async () => {
    const all = Object.fromEntries((await devtools.send('Performance.getMetrics')).metrics.map((m) => [m.name, m.value]));
    return {...await page.evaluate(() => globalThis.skein.figures()), script: all.ScriptDuration, task: all.TaskDuration};
  };
  while ((await stateOf(page))?.live !== 'yes' && !over) await sleep(10);
  const picture = performance.now();
  await sleep(1000);  // excludes work that is done only once
  let [first, last] = [null, null];
  while (!over) {
    const now = await metrics().catch(() => null);
    if (now !== null && (last === null || now.frames >= last.frames)) last = now;
    first ??= now;
    await sleep(2000);  // the query itself costs script time
  }
  const frames = last === null ? 0 : last.frames - first.frames;
  if (frames === 0) return {picture};  // the run ended too early
  return {
    picture, frames,
    script_ms: (1000 * (last.script - first.script)) / frames,
    thread_ms: (1000 * (last.task - first.task)) / frames,
    draw_calls: last.mostDrawCalls,
  };
}

const {picture, ...seen} = who === 'page' ? await look() : {};
const code = await ended;
if (browser !== null) await endBrowser(browser);
if (code !== 0) process.stderr.write(said);
else if (picture !== undefined) {
  const {startup_s: startup} = JSON.parse(readFileSync(path.join(run, 'result.json'), 'utf8'));
  seen.first_picture_ms = picture - begun - 1000 * startup;
}
console.log(JSON.stringify(seen));
process.exit(code);
