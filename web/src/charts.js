// Charts over time: the score, and a lane for each UAV. They zoom together and share a cursor.
import uPlot from 'uplot';

import {legendOfModes, spansOf} from './modes.js';
import {colour, data, element, growth, indexAt, moment, onTheme, replaceDrawing, shortName, trackColour} from './page.js';
import {barsOf} from './steps.js';

const sync = uPlot.sync('time');
const charts = [];
let zooming = false;
let zoomed = false;  // by the reader: new data then do not change the scale

/** Gives all charts the same interval of time as one chart. */
function zoomAll(from) {
  if (zooming) return;
  zooming = true;
  const {min, max} = from.scales.x;
  zoomed = min > 0 || max < data.end;
  for (const chart of charts)
    if (chart !== from) chart.setScale('x', {min, max});
  zooming = false;
}

const kFont = '11px system-ui, sans-serif';

const axis = (more) => ({
  stroke: () => colour('soft'),
  grid: {stroke: () => colour('line'), width: 1},
  ticks: {stroke: () => colour('line'), width: 1},
  font: kFont,
  ...more,
});

const timeAxis = () => axis({label: 'simulated time [s]', size: 26, labelSize: 20, labelGap: 2, labelFont: kFont});

/**
 * The time between two drawings of a chart whose data grow is at least kRefresh [ms], and kRest times the time of a
 * drawing.
 */
const kRefresh = 1000;
const kRest = 30;

/** Redraws a chart when its data have grown, but not too often; the last change is always drawn. */
function refresh(made, columns) {
  let due = 0;
  let later = 0;
  const draw = () => {
    const now = performance.now();
    clearTimeout(later);
    later = 0;
    zooming = true;
    made.setData(columns(), !zoomed);
    if (zoomed) made.redraw();
    zooming = false;
    due = now + Math.max(kRefresh, kRest * (performance.now() - now));
  };
  growth.listen(() => {
    const wait = due - performance.now();
    if (wait <= 0) draw();
    else if (later === 0) later = setTimeout(draw, wait);
  });
}

/** @param columns  returns the chart's data: a column of times [s], and columns of values. */
function chart(figure, height, options, columns) {
  const place = element('div', {class: 'live live-chart'});
  replaceDrawing(figure, place);
  const hint = element(
      'p', {class: 'live live-hint'}, 'Drag to zoom, double click to see all; a click moves the time of the 3D view.');
  const made = new uPlot(
      {
        width: Math.max(place.clientWidth, 200),
        height,
        cursor: {sync: {key: sync.key, setSeries: false}, drag: {x: true, y: false}},
        ...options,
        scales: {
          x: {
            time: false,
            range: (u, min, max) => (min == null ? [0, data.end] : [Math.max(0, min), Math.min(data.end, max)])
          },
          ...options.scales
        },
        hooks: {setScale: [(u, key) => key === 'x' && zoomAll(u)], ...options.hooks},
      },
      columns(),
      place,
  );
  refresh(made, columns);
  place.append(hint);
  charts.push(made);
  made.over.addEventListener('click', () => {
    if (made.cursor.left >= 0) moment.set(made.posToVal(made.cursor.left, 'x'));
  });
  new ResizeObserver(() => {
    if (place.clientWidth > 0 && place.clientWidth !== made.width) made.setSize({width: place.clientWidth, height});
  }).observe(place);
  onTheme(() => made.redraw());
  let marked = false;  // while it marks a moment in the past; the newest moment has no mark
  moment.listen(() => {
    const marks = moment.seconds < data.end;
    if (marks || marked) made.redraw(false);
    marked = marks;
  });
  return made;
}

/** Draws bars for the durations of faults, behind the curves. */
function drawFaults(u) {
  const {ctx, bbox} = u;
  ctx.save();
  ctx.fillStyle = colour('fault');
  for (const fault of data.faults) {
    const left = Math.max(u.valToPos(fault.from, 'x', true), bbox.left);
    const right = Math.min(u.valToPos(fault.until, 'x', true), bbox.left + bbox.width);
    if (right > left) ctx.fillRect(left, bbox.top, Math.max(right - left, 1), bbox.height);
  }
  ctx.restore();
}

/** Draws a line at the first difference between two flights. */
function drawDifference(u) {
  const at = u.valToPos(data.difference?.t ?? NaN, 'x', true);
  const {ctx, bbox} = u;
  if (!(at >= bbox.left && at <= bbox.left + bbox.width)) return;
  ctx.save();
  ctx.strokeStyle = colour('bad');
  ctx.lineWidth = 2 * devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(at, bbox.top);
  ctx.lineTo(at, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

/** Draws a line at the time that the 3D view shows. */
function drawMoment(u) {
  drawDifference(u);
  const at = u.valToPos(moment.seconds, 'x', true);
  const {ctx, bbox} = u;
  if (moment.seconds >= data.end || at < bbox.left || at > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = colour('ink');
  ctx.setLineDash([4, 4]);
  ctx.beginPath();
  ctx.moveTo(at, bbox.top);
  ctx.lineTo(at, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

/** In fleets of up to this size, each UAV has a row for its captures below the score. */
const kMostRows = 12;
const rows = data.uavs.length <= kMostRows ? data.uavs.length : 0;
const kRow = 0.04;  // height of a row, as a share of the chart's height

/**
 * Calls `use` for the counts per second that are to be drawn. Several seconds within a pixel become one, with their
 * largest count.
 */
function eachBusy(u, counts, use) {
  const {min, max} = u.scales.x;
  const step = Math.max(1, Math.floor((max - min) / Math.max(u.bbox.width, 1)));
  for (let second = 0; second < counts.length; second += step) {
    let most = 0;
    for (let i = second; i < Math.min(second + step, counts.length); ++i) most = Math.max(most, counts[i]);
    if (most > 0) use(most, [second, second + step]);
  }
}

/** Draws the seconds in which each UAV has taken captures. */
function drawCaptures(u) {
  const {ctx, bbox} = u;
  const each = (bbox.height * kRow * rows) / (1 + kRow * rows) / Math.max(rows, 1);
  data.uavs.slice(0, rows).forEach((uav, index) => {
    const top = bbox.top + bbox.height - each * (rows - index);
    eachBusy(u, uav.captures, (_, span) => drawSpans(u, span, trackColour(index), top + each * 0.15, each * 0.7));
  });
}

/** @returns the values of a curve of steps at the given times [s]. */
function sampled(curve, times) {
  const at = Float64Array.from(curve.t, (ms) => ms / 1000);
  return times.map((time) => {
    const index = indexAt(at, time + 1e-6);
    return index < 0 ? 0 : curve.v[index] / 1000;
  });
}

export function scoreChart(figure) {
  const runs = data.runs ?? [data];  // two runs on one clock, or one run
  const columns = () => {
    const curves = runs.flatMap(({earned, delivered}) => [earned, delivered]);
    const all = [0, ...curves.flatMap(({t}) => t.map((ms) => ms / 1000)), data.end];
    const times = [...new Set(all)].sort((a, b) => a - b);
    return [times, ...curves.map((one) => sampled(one, times))];
  };
  const stepped = uPlot.paths.stepped({align: 1});
  const one = (value) => (value == null ? '–' : value.toFixed(1));
  const curve = (label, name, dash) => ({
    label,
    stroke: () => colour(name),
    width: 2,
    dash,
    paths: stepped,
    points: {show: false},
    value: (u, v) => one(v),
  });
  chart(
      figure,
      320,
      {
        series: [
          {label: 'time', value: (u, v) => (v == null ? '–' : `${v.toFixed(1)} s`)},
          ...runs.flatMap((_, k) => {
            const [of, earned, delivered] = runs.length === 1 ? ['', 'c1', 'c0'] : [`${'AB'[k]} `, 'soft', k === 0 ? 'c0' : 'c1'];
            return [curve(`${of}earned`, earned, k === 0 ? [6, 4] : [2, 4]), curve(`${of}delivered`, delivered)];
          })
        ],
        axes: [
          timeAxis(),
          axis({size: 54, filter: (u, splits) => splits.map((split) => (split < 0 ? null : split))})
        ],
        scales: {
          y: {
            range: (u, min, max) => {
              const high = Math.max((max ?? 0) * 1.04, 1);
              return [-high * kRow * rows, high];
            }
          }
        },
        hooks: {drawClear: [drawFaults, drawCaptures], draw: [drawMoment]},
      },
      columns,
  );
}

const kLane = 54;
const kLowLane = 30;        // in a large fleet on the page that follows a run; the rows of such a lane have no names
const kLargeFleet = 8;
const kRoomForNames = 700;  // pixels; in narrower charts, the rows of a lane have no names
const laneHeight = () =>
    data.uavs.length > 20 ? 20 : data.follows && data.uavs.length > kLargeFleet ? kLowLane : kLane;

/** Draws filled spans of a lane. @param flat  begin and end of each span, one after the other [s]. */
function drawSpans(u, flat, name, top, height) {
  const {ctx, bbox} = u;
  ctx.fillStyle = colour(name);
  for (let i = 0; i + 1 < flat.length; i += 2) {
    const left = Math.max(u.valToPos(flat[i], 'x', true), bbox.left);
    const right = Math.min(u.valToPos(flat[i + 1], 'x', true), bbox.left + bbox.width);
    if (right > left) ctx.fillRect(left, top, Math.max(right - left, 0.5), height);
  }
}

function drawLane(u, uav, index, most) {
  const {ctx, bbox} = u;
  const ratio = devicePixelRatio;
  const each = bbox.height / data.uavs.length;
  const strip = each * 0.2;
  const top = bbox.top + each * index + each * 0.06;
  const end = uav.collided ?? data.end;
  const said = data.saidBy?.(index) ?? null;
  drawSpans(u, [0, end], 'flying', top, strip);
  if (said === null) drawSpans(u, uav.still, 'still', top, strip);
  else for (const {colour, flat} of spansOf(said, end)) drawSpans(u, flat, colour, top, strip);
  if (uav.collided != null) drawSpans(u, [end, data.end], 'bad', top, strip);
  drawSpans(u, uav.direct, 'direct', top + strip * 1.15, strip);
  drawSpans(u, uav.relayed, 'relayed', top + strip * 1.15, strip);
  const base = top + strip * 4.4;
  const peak = uav.captures.reduce((a, b) => Math.max(a, b), 1);
  eachBusy(u, uav.captures, (count, span) => {
    ctx.globalAlpha = 0.25 + (0.75 * count) / peak;
    drawSpans(u, span, 'soft', top + strip * 2.3, strip);
  });
  ctx.globalAlpha = 0.75;
  ctx.fillStyle = colour('c1');
  for (const [from, to, waited] of barsOf(uav.waiting, 1000 * data.end, (ms) => u.valToPos(ms / 1000, 'x', true))) {
    const left = Math.max(from, bbox.left);
    const right = Math.min(to, bbox.left + bbox.width);
    const height = Math.max((waited / most) * strip, 1);
    if (waited > 0 && right > left) ctx.fillRect(left, base - height, Math.max(right - left, 0.5), height);
  }
  ctx.globalAlpha = 1;
  ctx.fillStyle = colour('ink');
  ctx.font = `${11 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'right';
  ctx.textBaseline = 'middle';
  const named = u.width >= kRoomForNames && laneHeight() === kLane;
  if (named) ctx.textAlign = 'left';
  ctx.fillText(shortName(uav.name, 11), named ? 4 * ratio : bbox.left - 8 * ratio, top + strip * (named ? 0.6 : 2));
  if (!named) return;
  ctx.textAlign = 'right';
  ctx.fillStyle = colour('soft');
  ctx.font = `${9 * ratio}px system-ui, sans-serif`;
  [said === null ? 'flying, still' : 'what it does', 'station', 'captures', 'undelivered'].forEach(
      (row, i) => ctx.fillText(row, bbox.left - 6 * ratio, top + strip * (0.55 + 1.15 * i)));
}

export function lanesChart(figure) {
  if (data.uavs.length === 0) return;
  const lane = laneHeight();
  const draw = (u) => {
    const most = Math.max(1, ...data.uavs.map((uav) => uav.waiting.v.reduce((a, b) => Math.max(a, b), 0)));
    u.ctx.save();
    data.uavs.forEach((uav, index) => drawLane(u, uav, index, most));
    u.ctx.restore();
    drawMoment(u);
  };
  const columns = () => {
    const times = Array.from({length: Math.floor(data.end) + 1}, (_, second) => second);
    if (times.at(-1) < data.end) times.push(data.end);
    return [times, times.map(() => 0)];
  };
  chart(
      figure,
      lane * data.uavs.length + 50,
      {
        legend: {show: false},
        series: [{}, {show: false}],
        axes: [
          timeAxis(),
          axis({
            size: (u) => (u.width < kRoomForNames || laneHeight() === kLowLane ? 78 : 142),
            values: () => [],
            grid: {show: false},
            ticks: {show: false}
          })
        ],
        scales: {y: {range: [0, 1]}},
        hooks: {drawClear: [drawFaults], draw: [draw]},
      },
      columns,
  );
  if (data.follows) figure.append(legendOfModes());
}
