// How much of its past the page keeps, so that a flight of an hour takes as much memory as one of ten minutes: the
// newest part whole, what is older coarser. Lists have a most; when they reach it, their older half is thinned to half as
// many entries, evenly over its time.

/** Of each UAV: poses of 800 s, one each half second, before any are thinned. */
export const kMostPoses = 1600;
/** Steps of a curve: of score, of captures that wait. */
export const kMostSteps = 4000;
/** Of the radio links of all. */
export const kMostLinks = 2400;
/** What a UAV said that it does. */
export const kMostSayings = 600;
/** Numbers in a list of spans, two each. */
export const kMostSpans = 1000;
export const kMostEvents = 2000;

/** @param columns  lists of the same length, the first of times, in their order. @returns whether anything went. */
export function thin(columns, most) {
  const [times] = columns;
  const {length} = times;
  if (length < most) return false;
  const half = length >> 1;
  const least = (times[half] - times[0]) / (half >> 1);  // between two that stay
  let [kept, due] = [0, -Infinity];
  for (let i = 0; i < length; ++i) {
    const time = times[i];
    if (i < half && time < due) continue;
    due = time + least;
    for (const column of columns) column[kept] = column[i];
    ++kept;
  }
  for (const column of columns) column.length = kept;
  return true;
}

/** Spans, begin and end one after the other: the shortest ones, and the shortest gaps between them, go. */
export function thinSpans(spans, most = kMostSpans) {
  if (spans.length < most) return;
  for (let least = 0.5; spans.length > most / 2; least *= 2) {
    let kept = 0;
    for (let i = 0; i < spans.length; i += 2) {
      if (kept > 0 && spans[i] - spans[kept - 1] < least)
        spans[kept - 1] = spans[i + 1];
      else if (spans[i + 1] - spans[i] >= least) {
        spans[kept++] = spans[i];
        spans[kept++] = spans[i + 1];
      }
    }
    spans.length = kept;
  }
}

/** What happened: of the older half go deliveries first, which are many, then every second of what is left. */
export function thinEvents(events, most = kMostEvents) {
  if (events.length < most) return;
  const half = events.length >> 1;
  const stay = events.filter(({event}, i) => i >= half || event !== 'delivered');
  const crowded = stay.length > 0.75 * most;
  events.splice(0, events.length, ...stay.filter((_, i) => !crowded || i >= stay.length >> 1 || i % 2 === 0));
}
