#include "report/style.hpp"

namespace skein::report {

// The colours of planners (c) and tracks (t) are Okabe and Ito's, which people with any colour vision can tell apart,
// made darker or lighter where the background requires it. Qualities (q) are steps of a single hue, so that they do not
// look like tracks.
std::string_view base_style() {
  return R"css(:root {
  color-scheme: light dark;
  --font: system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
  --page: #ffffff; --panel: #f7f8fa; --ink: #1b2330; --soft: #5c6675; --line: #d5dae1; --mark: #eef3fa;
  --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #b8578f; --c4: #b97f00; --c5: #3b8fc4; --c6: #6b6b6b;
  --t0: #d55e00; --t1: #00855f; --t2: #c0609a; --t3: #c98a00; --t4: #2a2f38; --t5: #8b5a2b;
  --q0: #cfd4db; --q1: #a9cbe8; --q2: #6aa6d8; --q3: #2d7bbf; --q4: #0b4a86;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12161c; --panel: #1a2028; --ink: #e6eaf0; --soft: #9aa5b4; --line: #343d49; --mark: #1f2a38;
    --c0: #56b4e9; --c1: #f08a4b; --c2: #2fc79b; --c3: #e39bc4; --c4: #e9b949; --c5: #8fc7ee; --c6: #b3b3b3;
    --t0: #ff8a4a; --t1: #2fc79b; --t2: #e8a3cb; --t3: #f0bb3d; --t4: #f2f4f7; --t5: #c99a6b;
    --q0: #3f4854; --q1: #2f5b86; --q2: #3f80bd; --q3: #64a9e4; --q4: #b3d9fb;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 15px/1.5 var(--font); }
main { max-width: 1240px; margin: 0 auto; padding: 20px 20px 40px; }
h1 { font-size: 1.6em; line-height: 1.2; margin: 0.4em 0; overflow-wrap: anywhere; }
h2 { font-size: 1.25em; margin: 2em 0 0.5em; padding-bottom: 0.2em; border-bottom: 1px solid var(--line); }
h3 { font-size: 1.05em; margin: 1.6em 0 0.4em; }
p, ul { max-width: 75ch; margin: 0.5em 0; }
.soft, small { color: var(--soft); }
code, pre { font: 0.92em ui-monospace, "DejaVu Sans Mono", monospace; }
pre { background: var(--panel); border: 1px solid var(--line); border-radius: 6px; padding: 10px 12px; white-space: pre-wrap; overflow-wrap: anywhere; }
/* A shadow at the right edge says that a table goes on; the end of the table covers it. */
.wide { overflow-x: auto; background: linear-gradient(to left, var(--page) 40%, transparent) right / 30px 100% no-repeat local,
  linear-gradient(to left, var(--soft), transparent) right / 10px 100% no-repeat scroll; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 5px 10px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; vertical-align: top; }
thead th { color: var(--soft); font-weight: 600; font-size: 0.85em; line-height: 1.25; vertical-align: bottom; white-space: normal; min-width: 5.2em; }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: var(--page); }
thead th:first-child { min-width: 3em; }
td.name, th.name { text-align: left; white-space: normal; overflow-wrap: anywhere; min-width: 11em; max-width: 18em; }
td.name div { display: flex; align-items: baseline; }
td small { display: block; line-height: 1.2; font-size: 0.78em; font-weight: 400; }
td.best, tr.best td.decides { font-weight: 700; }
td.decides { background: var(--mark); }
.swatch { display: inline-block; flex: none; width: 0.75em; height: 0.75em; border-radius: 2px; margin-right: 0.45em; vertical-align: -0.03em; }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(280px, 100%), 1fr)); gap: 16px; margin: 12px 0; }
.panels.large { grid-template-columns: repeat(auto-fit, minmax(min(340px, 100%), 1fr)); }
figure { margin: 0; background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 10px 12px 6px; min-width: 0; }
figcaption { font-weight: 600; line-height: 1.3; overflow-wrap: anywhere; }
figcaption small { font-weight: 400; display: block; }
svg { display: block; width: 100%; height: auto; max-width: 560px; margin: 4px auto 0; }
.time-chart { padding: 0 12px 0 66px; max-width: 640px; margin: 4px auto 0; box-sizing: border-box; }
.time-chart svg { max-width: none; margin: 0; overflow: visible; }
.time-chart .stretched { height: 100%; }
.time-chart .stretched path { vector-effect: non-scaling-stroke; }
.time-chart.lanes { padding-left: 150px; } .lanes .names { transform: translateX(-148px); }
.legend { display: flex; flex-wrap: wrap; gap: 2px 18px; margin: 6px 0; padding: 0; font-size: 0.88em; list-style: none; max-width: none; }
.legend .track { stroke-width: 2.4; stroke-opacity: 1; }
.legend .track.explorer { stroke-width: 4; }
.legend svg { display: inline-block; width: 22px; height: 10px; margin: 0 5px 0 0; vertical-align: 0; }
@media (max-width: 600px) {
  .time-chart.lanes { padding-left: 70px; } .lanes .names { transform: translateX(-68px); } .lanes .rows { display: none; }
  main { padding: 8px 12px 24px; }
  td.name, th.name { min-width: 7.5em; max-width: 9em; }
  th, td { padding: 4px 7px; }
}
@media print {
  :root {
    color-scheme: light;
    --page: #ffffff; --panel: #ffffff; --ink: #000000; --soft: #444444; --line: #bbbbbb; --mark: #eeeeee;
    --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #b8578f; --c4: #b97f00; --c5: #3b8fc4; --c6: #6b6b6b;
    --t0: #d55e00; --t1: #00855f; --t2: #c0609a; --t3: #c98a00; --t4: #2a2f38; --t5: #8b5a2b;
    --q0: #cfd4db; --q1: #a9cbe8; --q2: #6aa6d8; --q3: #2d7bbf; --q4: #0b4a86;
  }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  main { max-width: none; padding: 0; }
  .wide { overflow: visible; background: none; }
  table { font-size: 8pt; }
  th, td { padding: 2px 4px; }
}
)css";
}

std::string_view drawing_style() {
  return R"css(svg text { font: 10px var(--font); fill: var(--soft); }
svg text.name { fill: var(--ink); font-size: 11px; }
svg text.middle { text-anchor: middle; }
svg text.end { text-anchor: end; }
.picture text { font-size: 8.5px; }
.picture text.name { font-size: 8.5px; fill: var(--soft); }
.grid { stroke: var(--line); stroke-width: 0.7; fill: none; }
.axis { stroke: var(--soft); stroke-width: 0.9; fill: none; }
.zero { stroke: var(--ink); stroke-width: 1.1; }
.c0 { color: var(--c0); } .c1 { color: var(--c1); } .c2 { color: var(--c2); } .c3 { color: var(--c3); }
.c4 { color: var(--c4); } .c5 { color: var(--c5); } .c6 { color: var(--c6); } .neutral { color: var(--ink); }
.whisker { stroke: currentColor; stroke-width: 1.2; }
.box { fill: currentColor; fill-opacity: 0.18; stroke: currentColor; stroke-width: 1.2; }
.median { stroke: currentColor; stroke-width: 2.6; }
.interval { stroke: currentColor; stroke-width: 5; stroke-opacity: 0.3; }
.dot { fill: currentColor; fill-opacity: 0.75; stroke: var(--panel); stroke-width: 0.6; }
.band { fill: currentColor; fill-opacity: 0.13; stroke: none; }
.curve { fill: none; stroke: currentColor; stroke-width: 2; stroke-linejoin: round; }
.points path { fill: none; stroke-linecap: round; }
.q0 { stroke: var(--q0); } .q1 { stroke: var(--q1); } .q2 { stroke: var(--q2); } .q3 { stroke: var(--q3); } .q4 { stroke: var(--q4); }
.bounds { stroke: var(--soft); stroke-width: 0.8; stroke-opacity: 0.65; stroke-dasharray: 3 2; fill: none; }
.track { fill: none; stroke-width: 0.9; stroke-linejoin: round; stroke-opacity: 0.85; }
.track.explorer { stroke-width: 1.6; }
.track.again { stroke-dasharray: 5 2; }
.start { stroke: var(--panel); stroke-width: 0.7; }
.track.t0 { stroke: var(--t0); } .track.t1 { stroke: var(--t1); } .track.t2 { stroke: var(--t2); }
.track.t3 { stroke: var(--t3); } .track.t4 { stroke: var(--t4); } .track.t5 { stroke: var(--t5); }
.start.t0 { fill: var(--t0); } .start.t1 { fill: var(--t1); } .start.t2 { fill: var(--t2); }
.start.t3 { fill: var(--t3); } .start.t4 { fill: var(--t4); } .start.t5 { fill: var(--t5); }
.station { fill: var(--ink); } .collision { stroke: var(--bad); stroke-width: 2.4; fill: none; stroke-linecap: round; }
)css";
}

}  // namespace skein::report
