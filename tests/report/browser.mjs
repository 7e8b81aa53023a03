// Opens pages in a browser, collects their complaints, and computes figures of their pictures.
import {createRequire} from 'node:module';
import path from 'node:path';

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/**
 * Waits until a fact holds, however slow the machine is. If that never happens, the test that started the script ends
 * it, and shows its messages on stderr. @param ask  returns a value to check; if it throws, the value is null.
 * @param holds  the fact, as a function of this value. @param what  describes the fact. @returns the value for which it
 * held.
 */
export async function waitUntil(ask, holds, what) {
  const kQuiet = 20000;  // ms
  const patient = async () => {
    try {
      return await ask();
    } catch {
      return null;  // the page cannot answer now, for example because it reloads
    }
  };
  for (let told = Date.now();;) {
    const seen = await patient();
    if (seen !== null && holds(seen)) return seen;
    if (Date.now() - told > kQuiet) {
      console.error(`waits: ${what}; the page says ${JSON.stringify(seen)}`);
      told = Date.now();
    }
    await sleep(100);
  }
}

/**
 * @param browser  or a context of it.
 * @returns a new page, whose functions wait without a timeout, like waitUntil().
 */
export async function openTab(browser) {
  const page = await browser.newPage();
  page.setDefaultTimeout(0);
  return page;
}

/** @param web  the folder with the package.json that lists puppeteer-core. */
export async function openBrowser(web, executablePath) {
  const require = createRequire(path.join(web, 'package.json'));
  const puppeteer = (await import(require.resolve('puppeteer-core'))).default;
  const asRoot = process.getuid() === 0 ? ['--no-sandbox'] : [];  // Chromium has no sandbox for root
  return puppeteer.launch({
    executablePath,
    headless: true,
    timeout: 0,
    protocolTimeout: 0,
    pipe: true,  // Chromium ends with this script, also if the script is killed
    args: [...asRoot, '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage'],
  });
}

/**
 * Ends the browser and all its processes by a signal, because a busy Chromium may not answer a request to close.
 * @returns once its main process has ended.
 */
export async function endBrowser(browser) {
  const chromium = browser.process();
  const ended = new Promise((resolve) => chromium.once('exit', resolve));
  process.kill(-chromium.pid, 'SIGKILL');  // puppeteer starts it as the leader of a process group
  await ended;
}

/** Opens a file. @returns the page, and its complaints (the list grows): errors, and requests for other resources. */
export async function openPage(browser, file, {width, scheme}) {
  const page = await openTab(browser);
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    const url = request.url();
    if (url !== `file://${file}` && !url.startsWith('data:') && !url.startsWith('blob:'))
      complaints.push(`asks for ${url}`);
  });
  await page.setViewport({width, height: 900});
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
  await page.goto(`file://${file}`, {waitUntil: 'load'});
  return {page, complaints};
}

let table = null;  // a page of its own, in which pictures are evaluated

/**
 * Evaluates parts of a picture (base64 PNG): number of colours, share of the most frequent one, brightness (0 to 1).
 * @param parts  [left, top, width, height] of each part [pixels]; null: the whole picture.
 * @returns a list of figures; for the whole picture, its figures.
 */
export async function lookAt(browser, png, parts = null) {
  table ??= await openTab(browser);
  const seen = await table.evaluate(async (source, rectangles) => {
    const image = new Image();
    image.src = `data:image/png;base64,${source}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return (rectangles ?? [[0, 0, image.width, image.height]]).map((rectangle) => {
      const {data} = context.getImageData(...rectangle);
      const counts = new Map();
      let sum = 0;
      for (let i = 0; i < data.length; i += 4) {
        const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
        counts.set(colour, (counts.get(colour) ?? 0) + 1);
        sum += data[i] + data[i + 1] + data[i + 2];
      }
      const pixels = data.length / 4;
      return {colours: counts.size, largest: Math.max(...counts.values()) / pixels, brightness: sum / pixels / 765};
    });
  }, png, parts);
  return parts === null ? seen[0] : seen;
}
