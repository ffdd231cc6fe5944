// The style sheet of the program's HTML pages.
#pragma once

namespace edgescout {

inline constexpr const char* PAGE_STYLE = R"(
:root{--ink:#1c2430;--soft:#64707f;--line:#dde3ea;--paper:#f6f8fa;--accent:#c2255c}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1160px;padding:28px 24px 60px;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;font-variant-numeric:tabular-nums}
h1{font-size:28px;margin:0}h1 em{font-style:normal;color:var(--accent)}header p{margin:2px 0 18px;color:var(--soft)}
h2{font-size:19px;margin:0 0 12px}h2 small{font-weight:400;font-size:15px;color:var(--soft);margin-left:6px}
.tiles{display:flex;flex-wrap:wrap;gap:12px;margin-bottom:20px}
.tile{flex:1 1 150px;background:#fff;border:1px solid var(--line);border-radius:10px;padding:12px 16px}
.tile b{display:block;font-size:21px;line-height:1.2}.tile span{font-size:13px;color:var(--soft)}
section{background:#fff;border:1px solid var(--line);border-radius:12px;padding:20px 22px;margin-bottom:20px}
.row{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,480px),1fr));gap:18px;margin-top:14px}
figure{margin:0}figcaption{font-size:13px;color:var(--soft);margin-top:5px}
.picture{display:block;width:100%;height:auto;border-radius:8px;border:1px solid var(--line)}
.hidden{position:absolute;width:0;height:0}
table{border-collapse:collapse;width:100%;font-size:14px}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1px solid var(--line);padding:4px 12px 4px 0}
td{border-bottom:1px solid #eef1f5;padding:4px 12px 4px 0}td.right{color:#157347}td.wrong{color:#c92a2a}
.warning{background:#fff4e6;border-left:4px solid #f08c00;padding:8px 14px;border-radius:6px;margin:0 0 14px}
.numbers{font-size:13px;color:var(--soft);margin:14px 0 0}.numbers b{color:var(--ink)}.stage{white-space:nowrap;background:var(--paper);border-radius:6px;padding:1px 7px;margin:0 2px}
.legend dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 18px;margin:0;font-size:14px}
.legend dt{font-weight:600}.legend dd{margin:0;color:var(--soft)}
.hemisphere{display:block;width:100%;height:auto}
.ring{fill:none;stroke:#dfe5ec}.tick{font-size:10px;fill:#98a2b0;text-anchor:middle}.label{font-size:12px;fill:var(--soft)}
.way{fill:none;stroke:#1c2430;stroke-width:1.5;stroke-dasharray:4 4;opacity:.55}
.view{stroke:#8a96a5;stroke-width:1}.taken{fill:#1c2430}.number{font-size:11px;font-weight:700;fill:#fff;text-anchor:middle}
.chosen{fill:none;stroke:var(--accent);stroke-width:3.5}.cross{stroke:#c92a2a;stroke-width:2.5}
.picture g{stroke-width:1.6;fill:none}.picture use{filter:brightness(.8) contrast(.75)}
)";

}  // namespace edgescout
