#include "report/style.hpp"

namespace skein::report {

// The colours of causes (k) are Tol's muted colours, which people with any colour vision can tell apart.
std::string_view run_style() {
  return R"css(:root {
  --k0: #8a8f98; --k1: #332288; --k2: #cc6677; --k3: #882255; --k4: #c98a00; --k5: #3a9fcf; --k6: #2f9585; --k7: #8f8f2a; --k8: #aa4499; --k9: #5b7fa6; --k10: #a5501e; --k11: #117733;
  --flying: #a9cbe8; --still: #e3a63a; --direct: #2f9585; --relayed: #a3d3cb; --fault: #d55e0033; --good: #00734f; --bad: #b3261e;
}
@media (prefers-color-scheme: dark) {
  :root {
    --k0: #9aa0aa; --k1: #8f83f0; --k2: #f08a9a; --k3: #d66aa6; --k4: #f0bb3d; --k5: #7fc9ee; --k6: #55c4b1; --k7: #cfcf5a; --k8: #d98fcb; --k9: #9dbbe0; --k10: #e09668; --k11: #5fc47a;
    --flying: #2f5b86; --still: #d9a13b; --direct: #3fae9b; --relayed: #245f56; --fault: #f08a4b3a; --good: #3fcf9b; --bad: #ff8a80;
  }
}
[hidden] { display: none !important; }
body.run main { max-width: 1560px; }
.run h1 { font-size: 1.9em; margin: 0 0 0.5em; }
.run h1 .by { color: var(--soft); font-weight: 400; }
.run .over { margin: 0; text-transform: uppercase; letter-spacing: 0.08em; font-size: 0.8em; }
.status { font-size: 0.5em; font-weight: 600; vertical-align: 0.3em; padding: 0.2em 0.7em; border-radius: 1em; border: 1.5px solid currentColor; white-space: nowrap; }
.status.good { color: var(--good); } .status.bad { color: var(--bad); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(190px, 46%), 1fr)); gap: 12px; margin: 8px 0 16px; }
.card { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 10px 14px; min-width: 0; }
.card > span { color: var(--soft); font-size: 0.86em; }
.card strong { display: block; font-size: 1.75em; line-height: 1.25; font-variant-numeric: tabular-nums; }
.card small { line-height: 1.3; display: block; }
.card.main { border-left: 4px solid var(--c0); } .card.bad { border-left: 4px solid var(--bad); }
.facts { display: flex; flex-wrap: wrap; gap: 6px 28px; margin: 12px 0; }
.facts dt { color: var(--soft); font-size: 0.8em; } .facts dd { margin: 0; font-weight: 600; overflow-wrap: anywhere; }
.facts .long dd { font-weight: 400; }
.command { margin: 10px 0; }
.note { border-left: 4px solid var(--still); background: var(--panel); border-radius: 4px; padding: 8px 14px; margin: 10px 0; }
.note.lost { border-color: var(--bad); } .note ul { margin: 0.2em 0; padding-left: 1.2em; max-width: none; overflow-wrap: anywhere; }
.absent { color: var(--soft); font-style: italic; }
.pair { display: grid; grid-template-columns: minmax(0, 1fr); gap: 0 28px; }
.halves { display: grid; grid-template-columns: minmax(0, 1fr); gap: 0 36px; align-items: start; }
@media (min-width: 1180px) { .pair { grid-template-columns: minmax(0, 5fr) minmax(0, 6fr); } .halves { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
.run td:first-child, .run th:first-child { background: var(--page); }
.words td:first-child { white-space: normal; }
.waterfall { width: 100%; }
.waterfall th:last-child, .waterfall td:last-child { width: 100%; min-width: 80px; padding: 3px 0 3px 10px; vertical-align: middle; }
.run svg.fall { max-width: none; width: 100%; height: 18px; margin: 0; }
.fall rect { fill: var(--c0); } .fall .whole { fill: var(--q0); }
.fall .k0 { fill: var(--k0); } .fall .k1 { fill: var(--k1); } .fall .k2 { fill: var(--k2); } .fall .k3 { fill: var(--k3); } .fall .k4 { fill: var(--k4); }
.fall .k5 { fill: var(--k5); } .fall .k6 { fill: var(--k6); } .fall .k7 { fill: var(--k7); } .fall .k8 { fill: var(--k8); } .fall .k9 { fill: var(--k9); }
.fall .k10 { fill: var(--k10); } .fall .k11 { fill: var(--k11); }
.run tr.sum td { font-weight: 700; border-top: 1.5px solid var(--soft); }
td.heat { background: color-mix(in srgb, var(--h) var(--v), transparent); }
.matrix td { text-align: center; } .matrix th { text-align: center; min-width: 4.5em; }
.matrix.dense td { padding: 4px; min-width: 8px; } .matrix.dense th { min-width: 0; padding: 0; } .matrix.dense td:first-child { font-size: 0.75em; padding: 0 6px; }
.matrix td small { color: inherit; opacity: 0.8; font-size: 0.72em; }
.run figure + .wide { margin-top: 14px; }
.pairs { margin-top: 12px; } .pairs td { border: none; padding: 2px 14px 2px 0; }
.points .k0 { stroke: var(--k0); } .points .k1 { stroke: var(--k1); } .points .k2 { stroke: var(--k2); } .points .k3 { stroke: var(--k3); } .points .k4 { stroke: var(--k4); }
.points .k5 { stroke: var(--k5); } .points .k6 { stroke: var(--k6); } .points .k7 { stroke: var(--k7); } .points .k8 { stroke: var(--k8); } .points .k9 { stroke: var(--k9); }
.points .k10 { stroke: var(--k10); } .points .k11 { stroke: var(--k11); }
.run svg, .run .time-chart { max-width: none; }
.views { grid-template-columns: repeat(auto-fit, minmax(min(520px, 100%), 1fr)); }
.places { grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); }
.known path { fill: var(--ink); stroke: none; } .known .m1 { fill: var(--direct); fill-opacity: 0.2; }
.known .m2 { fill-opacity: 0.3; } .known .m3 { fill-opacity: 0.5; } .known .m4 { fill-opacity: 0.7; } .known .m5 { fill-opacity: 0.95; }
.swatch.m1 { background: color-mix(in srgb, var(--direct) 20%, transparent); } .swatch.m2 { background: color-mix(in srgb, var(--ink) 30%, transparent); } .swatch.m3 { background: color-mix(in srgb, var(--ink) 50%, transparent); }
.swatch.m4 { background: color-mix(in srgb, var(--ink) 70%, transparent); } .swatch.m5 { background: color-mix(in srgb, var(--ink) 95%, transparent); }
.cross { color: var(--bad); }
.swatch.line { height: 3px; width: 1.2em; vertical-align: 0.22em; }
.curve.delivered { stroke: var(--c0); } .curve.earned { stroke: var(--c1); stroke-dasharray: 5 3; }
.fault { fill: var(--fault); }
.flying { fill: var(--flying); } .still { fill: var(--still); } .gone { fill: var(--bad); fill-opacity: 0.45; } .direct { fill: var(--direct); } .relayed { fill: var(--relayed); }
.rug { stroke: var(--soft); stroke-width: 0.7; fill: none; } .waiting { fill: var(--c1); fill-opacity: 0.75; stroke: none; }
.rug.t0 { stroke: var(--t0); } .rug.t1 { stroke: var(--t1); } .rug.t2 { stroke: var(--t2); } .rug.t3 { stroke: var(--t3); } .rug.t4 { stroke: var(--t4); } .rug.t5 { stroke: var(--t5); }
.bar { fill: var(--c0); } .bar.never { fill: var(--bad); }
details { margin: 12px 0; } summary { cursor: pointer; color: var(--soft); }
footer { margin-top: 3em; border-top: 1px solid var(--line); font-size: 0.88em; }
@media (max-width: 640px) {
  .picture text, .picture text.name { font-size: 11px; }
  .run h1 { font-size: 1.45em; } .card strong { font-size: 1.35em; } .card { padding: 8px 10px; }
  .waterfall th:nth-child(3), .waterfall td:nth-child(3) { display: none; }
  .waterfall td:first-child { white-space: normal; } .waterfall td:first-child { min-width: 9.5em; } .waterfall th:last-child, .waterfall td:last-child { min-width: 56px; }
}
@media print {
  :root {
    --k0: #8a8f98; --k1: #332288; --k2: #cc6677; --k3: #882255; --k4: #c98a00; --k5: #3a9fcf; --k6: #2f9585; --k7: #8f8f2a; --k8: #aa4499; --k9: #5b7fa6; --k10: #a5501e; --k11: #117733;
    --flying: #a9cbe8; --still: #e3a63a; --direct: #2f9585; --relayed: #a3d3cb; --fault: #d55e0033; --good: #00734f; --bad: #b3261e;
  }
  .live { display: none !important; } .still-drawing { display: block !important; }
  .card { break-inside: avoid; }
}
)css";
}

}  // namespace skein::report
