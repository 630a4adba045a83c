#include "html_style.hpp"

#include <fmt/format.h>

namespace plumbline::reports {
namespace {

// The yellow of Okabe and Ito's palette cannot be read on white and their black not on a dark ground: those two are
// darkened and lightened.
constexpr const char* kSheet = R"css(
:root{color-scheme:light dark;--bg:#fff;--fg:#1c2128;--soft:#5b6470;--line:#d8dde3;--panel:#f5f7f9;--link:#0b5cad;
--good:#d8f0e2;--good-fg:#0b5a34;--warn:#fdeecb;--warn-fg:#6d4a00;--bad:#fbd9d3;--bad-fg:#8f1d0c;--odd:#ecdcf3;
--odd-fg:#5f2a78;--none:#eceff2;--none-fg:#59626d;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#e69f00;--c5:#56b4e9;--c6:#a89a00;--c7:#1c2128}
@media(prefers-color-scheme:dark){:root{--bg:#14181d;--fg:#e4e8ec;--soft:#9aa5b1;--line:#333b45;--panel:#1c2229;
--link:#7db8f5;--good:#123d29;--good-fg:#9fe0bd;--warn:#4a3708;--warn-fg:#f5d68a;--bad:#55201a;--bad-fg:#ffb9ad;
--odd:#42264f;--odd-fg:#e3bdf5;--none:#262d35;--none-fg:#a3adb8;
--c0:#4da3dd;--c1:#f07f2e;--c2:#1fc296;--c3:#dd94bb;--c4:#f0b030;--c5:#8fd0f7;--c6:#f0e442;--c7:#e4e8ec}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:94rem;padding:1rem 1.25rem 4rem;background:var(--bg);color:var(--fg);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.6rem 0 .3rem}
h2{font-size:1.3rem;margin:2.6rem 0 .4rem;padding-top:.8rem;border-top:1px solid var(--line)}
h3{font-size:1.02rem;margin:1.3rem 0 .4rem}
h2,h3,td,th,dd{overflow-wrap:anywhere}
p{margin:.4rem 0}a{color:var(--link)}
.lead{font-size:1.08rem}.soft{color:var(--soft)}.small{font-size:.88rem}
.banner{background:var(--bad);color:var(--bad-fg);padding:.6rem .9rem;border-radius:.4rem}
.chips{display:flex;flex-wrap:wrap;gap:.4rem;padding:0;margin:.8rem 0;list-style:none}
.badge{display:inline-block;padding:.05rem .5rem;border-radius:.35rem;white-space:nowrap;font-size:.9rem}
.chips .badge{font-size:1rem;padding:.15rem .7rem}
.v-pass{background:var(--good);color:var(--good-fg)}
.v-expected_fail{background:var(--warn);color:var(--warn-fg)}
.v-unexpected_pass,.v-nondeterministic{background:var(--odd);color:var(--odd-fg)}
.v-fail,.v-diverged,.v-crashed,.v-timed_out,.v-error{background:var(--bad);color:var(--bad-fg)}
.v-unsupported,.v-none{background:var(--none);color:var(--none-fg)}
.scroll{overflow-x:auto;max-width:100%;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums}
th,td{padding:.28rem .55rem;text-align:left;vertical-align:top;border-bottom:1px solid var(--line)}
thead th{color:var(--soft);font-weight:600;white-space:nowrap;vertical-align:bottom}
td.n,th.n{text-align:right;white-space:nowrap}td.none{color:var(--soft)}
td.text{min-width:13rem;max-width:26rem}
tbody th,td.word{white-space:nowrap;overflow-wrap:normal}
abbr{text-decoration:none}
.matrix{border-collapse:separate;border-spacing:2px}
.matrix th,.matrix td{border:0;vertical-align:middle}
.matrix tbody th{font-weight:500;white-space:nowrap;position:sticky;left:0;background:var(--bg);max-width:20rem;
overflow:hidden;text-overflow:ellipsis}
.matrix thead th{text-align:center}
.matrix td{padding:0;text-align:center;border-radius:.3rem;min-width:4.4rem}
.matrix td a{display:block;padding:.25rem .3rem;color:inherit;text-decoration:none;border-radius:.3rem}
.matrix td a:hover,.matrix td a:focus-visible{outline:2px solid var(--link)}
.matrix td b{display:block;line-height:1.1}.matrix td span{font-size:.78rem;white-space:nowrap}
.matrix.checks td{min-width:1.7rem}.matrix.checks td>span{display:block;padding:.15rem .2rem}
.matrix.checks td a{padding:.15rem .2rem}.matrix.checks .up{writing-mode:vertical-rl;transform:rotate(180deg)}
.matrix.checks thead th{vertical-align:bottom}
.matrix.checks tbody .theme{padding-top:.8rem;font-weight:600;color:var(--soft)}
td.wide{min-width:20rem;max-width:48rem}tr:target>*{background:var(--panel)}
.tabs>input{position:absolute;opacity:0;pointer-events:none}
.tabs>label{display:inline-block;padding:.25rem .8rem;margin:.2rem .15rem .2rem 0;border:1px solid var(--line);
border-radius:.4rem;cursor:pointer;font-size:.92rem}
.tabs>input:checked+label{background:var(--fg);color:var(--bg);border-color:var(--fg)}
.tabs>input:focus-visible+label{outline:2px solid var(--link);outline-offset:2px}
.panels>section{display:none}
.chart{background:var(--panel);border-radius:.5rem;padding:.4rem;margin:.5rem 0}
.chart svg{display:block;width:100%;min-width:36rem;height:auto}
.chart text{fill:var(--soft);font:12px system-ui,sans-serif}.chart .axis{font-size:13px;fill:var(--fg)}
.grid{stroke:var(--line);stroke-width:1}.floor{stroke:var(--soft);stroke-dasharray:2 4}
.curve{fill:none;stroke-width:1.8;stroke-linejoin:round}.curve.default{stroke-dasharray:7 4;stroke-width:1.4}
.curve:hover{stroke-width:4}
.mark{stroke-width:1.5}
.legend{display:flex;flex-wrap:wrap;gap:.15rem 1.1rem;padding:0;margin:.4rem 0;list-style:none;font-size:.88rem}
.legend svg{width:44px;height:14px;vertical-align:-2px;margin-right:.3rem}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem 1rem;margin:.4rem 0;font-size:.92rem}
dt{color:var(--soft)}dd{margin:0}
pre{background:var(--panel);padding:.6rem .8rem;border-radius:.4rem;overflow-x:auto;white-space:pre-wrap;
overflow-wrap:anywhere;font-size:.85rem}
details{margin:.5rem 0}summary{cursor:pointer}
.differs td{background:var(--warn);color:var(--warn-fg)}
.heat td{text-align:right;white-space:nowrap}.heat td.diag{color:var(--soft)}
.pair{display:flex;flex-wrap:wrap;gap:0 2.5rem}
@media(max-width:40rem){body{padding:.6rem .7rem 3rem}dl{grid-template-columns:1fr}dd{margin-bottom:.3rem}
.matrix tbody th{max-width:9rem}.matrix.checks tbody th{white-space:normal;max-width:11rem;line-height:1.25}}
@media print{.panels>section{display:block}.tabs>label{display:none}body{max-width:none}}
)css";

}  // namespace

std::string style_sheet(std::size_t tabs) {
  std::string sheet = kSheet;
  for (std::size_t k = 0; k < kCurveColors; ++k) {
    sheet += fmt::format(".k{0}{{stroke:var(--c{0})}}.f{0}{{fill:var(--c{0});stroke:var(--c{0})}}\n", k);
  }
  for (std::size_t k = 1; k <= tabs; ++k) {
    sheet += fmt::format(".tabs>input:nth-of-type({0}):checked~.panels>section:nth-of-type({0}){{display:block}}\n", k);
  }
  return sheet;
}

}  // namespace plumbline::reports
