// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cortex::profiler {

// Colours of series are those of Okabe and Ito, told apart by the colour-blind; lighter on dark.
inline constexpr const char* htmlStyle = R"(
:root{--page:#fff;--text:#1b1e23;--faint:#5c6470;--rule:#d5d9e0;--grid:#e8ebef;--box:#f5f6f8;
--good:#00694a;--bad:#b3261e;--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#a8559a;--c4:#c98a00;
--c5:#3a9bd0;--b0:#70757d;--b1:#9aa0a8;--b2:#555a61;--b3:#b0b5bc}
@media screen and (prefers-color-scheme:dark){:root{--page:#14171c;--text:#e4e7ec;--faint:#a0a8b4;
--rule:#3a414c;--grid:#262c35;--box:#1c2027;--good:#5fd3a6;--bad:#ff8a80;--c0:#5cb3ec;--c1:#ff8f4d;
--c2:#3ccf9f;--c3:#e09ad2;--c4:#f0ba45;--c5:#a3daf7;--b0:#9aa1ab;--b1:#747b86;--b2:#c0c5cc;
--b3:#5c636d}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem;max-width:1200px;background:var(--page);color:var(--text);
font:15px/1.5 system-ui,"Segoe UI","DejaVu Sans",sans-serif}
h1{font-size:1.6rem;margin:0}
h2{font-size:1.2rem;margin:2.2rem 0 .6rem}
h3{font-size:1.05rem;margin:0 0 .5rem}
p{margin:.3rem 0}
a{color:var(--c0)}
.faint,figcaption,.said{color:var(--faint)}
.good,.bad{white-space:nowrap}
.good{color:var(--good);font-weight:600}
.bad{color:var(--bad);font-weight:600}
.box{background:var(--box);border-left:4px solid var(--rule);padding:.6rem 1rem;margin:1rem 0}
.box.warn{border-color:var(--bad)}
.box ul{margin:.2rem 0;padding-left:1.2rem}
td:first-child,th:first-child{min-width:18em}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:.93rem}
th,td{padding:.32rem .7rem;text-align:left;vertical-align:top;border-bottom:1px solid var(--grid)}
th{border-bottom:2px solid var(--rule);font-weight:600}
.n{text-align:right;white-space:nowrap}
.base{text-align:right;max-width:15rem}
.aim{min-width:8rem}
.paper{min-width:9rem}
.machine{display:grid;grid-template-columns:repeat(auto-fill,minmax(21rem,1fr));gap:0 2rem;
margin:0;font-size:.9rem}
.machine div{display:flex;gap:1rem;padding:.2rem 0;border-bottom:1px solid var(--grid)}
.machine dt{flex:0 0 9.5rem;color:var(--faint)}
.machine dd{margin:0}
.wide{overflow-x:auto}
figure{margin:1.2rem 0;padding:1rem 0;border-top:1px solid var(--rule)}
.beside{display:grid;grid-template-columns:minmax(0,1fr) 17rem;gap:1.5rem}
.beside h4{margin:0;font-size:.82rem;color:var(--faint);font-weight:600}
.beside aside{font-size:.93rem}
.beside aside p{margin:0 0 1rem}
@media (max-width:900px){.beside{grid-template-columns:1fr}}
figure svg{display:block;width:100%;height:auto;font:12.5px system-ui,"Segoe UI","DejaVu Sans",sans-serif}
figure svg.sample{display:inline-block;width:34px;height:12px;vertical-align:middle;margin-right:.3rem}
.legend{display:flex;flex-wrap:wrap;gap:.2rem 1.4rem;list-style:none;margin:.3rem 0 0;padding:0 0 0 3rem;
font-size:.9rem}
.said{font-size:.85rem}
text{fill:var(--text)}
text.title{fill:var(--faint)}
text.of-mark{fill:var(--faint);font-size:12px}
.end{text-anchor:end}
.middle{text-anchor:middle}
.grid{stroke:var(--grid)}
.axis,.tick{stroke:var(--faint)}
.mark{stroke:var(--faint);stroke-dasharray:1.5 3;stroke-width:1.4}
path.line{fill:none;stroke-width:1.9;stroke-linejoin:round}
.c0{stroke:var(--c0);fill:var(--c0)}.c1{stroke:var(--c1);fill:var(--c1)}
.c2{stroke:var(--c2);fill:var(--c2)}.c3{stroke:var(--c3);fill:var(--c3)}
.c4{stroke:var(--c4);fill:var(--c4)}.c5{stroke:var(--c5);fill:var(--c5)}
.b0{stroke:var(--b0);fill:var(--page)}.b1{stroke:var(--b1);fill:var(--page)}
.b2{stroke:var(--b2);fill:var(--page)}.b3{stroke:var(--b3);fill:var(--page)}
.b0 path.line{stroke-dasharray:7 4}.b1 path.line{stroke-dasharray:3 3}
.b2 path.line{stroke-dasharray:10 3 2 3}.b3 path.line{stroke-dasharray:12 5}
g path.line.dense{stroke-dasharray:none;stroke-width:1;stroke-opacity:.8}
@media print{body{max-width:none;padding:0;font-size:11px}
figure,tr,.box{break-inside:avoid}.beside{grid-template-columns:minmax(0,1fr) 12rem}
nav{display:none}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

}  // namespace cortex::profiler
