// A curve of steps as what there is to draw. Pure.

/**
 * Steps that are narrower than a pixel are drawn as one, of the most that they reach; a wider one is drawn by itself.
 * @param t, v  when each step begins, and its value. @param end  of the last one. @param place  of a time, in pixels
 * @returns [from, to, value] of each bar, in pixels, in order.
 */
export function barsOf({t, v}, end, place) {
  const bars = [];
  for (let i = 0; i < t.length;) {
    const first = i;
    const from = place(t[i]);
    let [to, most] = [from, 0];
    do {
      const next = place(i + 1 < t.length ? t[i + 1] : end);
      if (i > first && next - place(t[i]) >= 1) break;
      most = Math.max(most, v[i++]);
      to = next;
    } while (i < t.length && to - from < 1);
    bars.push([from, to, most]);
  }
  return bars;
}
