// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.hpp"

#include "report/number_text.hpp"
#include "report/quantity_text.hpp"
#include "report/results_files.hpp"

namespace cortex::profiler {
namespace {

constexpr const char* style = R"(
body{margin:0 auto;padding:1.5rem;max-width:1100px;font:15px/1.5 sans-serif;color:#1b1e23}
h2{margin:2rem 0 .6rem}h3{margin:2.2rem 0 .3rem}p{margin:.3rem 0}
table{border-collapse:collapse;width:100%;font-size:.92em;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .6rem;text-align:left;vertical-align:top;border-bottom:1px solid #e4e7eb}
tr.group th{padding-top:1.2rem;border-bottom:2px solid #8a9099}
.n{text-align:right;white-space:nowrap}.aim{white-space:nowrap}
.met{color:#00694a}.MISSED{color:#b3261e;font-weight:bold}.not{color:#8a5a00;font-weight:bold}
.faint{color:#5c6470;font-size:.92em}.box{background:#f3f4f6;padding:.5rem 1rem;margin:1rem 0}
svg{max-width:100%;height:auto}pre{max-height:20rem;overflow:auto;background:#f3f4f6}
@media print{body{max-width:none;font-size:11px}section,tr{break-inside:avoid}details,nav{display:none}}
)";

std::string element(const std::string& name, const std::string& inner) {
    return "<" + name + ">" + inner + "</" + name.substr(0, name.find(' ')) + ">";
}

std::string list(const std::string& heading, const std::vector<std::string>& entries) {
    if (entries.empty()) return {};
    std::string text;
    for (const std::string& entry : entries) text += element("li", escaped(entry)) + "\n";
    return "<div class=\"box\">" + element("b", heading) + "<ul>\n" + text + "</ul></div>\n";
}

std::string head(const Results& results) {
    const Aims aims = aimsOf(results);
    const std::size_t met = aims.all - aims.missed.size() - aims.notJudged.size();
    std::string text = "<h1>CorteX profiler</h1>\n<p class=\"faint\">" +
                       escaped(results.started + ", CorteX " + results.version) + ", <code>" +
                       escaped(results.command) + "</code></p>\n";
    if (!results.complete) {
        text +=
            "<div class=\"box\"><b>Not complete.</b> The run was stopped, failed in part, or "
            "still goes on: below is what it had measured.</div>\n";
    }
    if (aims.all > 0) {
        text +=
            "<p>Aims met: " + std::to_string(met) + " of " + std::to_string(aims.all) + ".</p>\n";
    }
    return text + list("Missed", aims.missed) + list("Not judged, run it again", aims.notJudged) +
           list("To be known when reading this", results.notes);
}

std::string machine(const Results& results) {
    std::string rows;
    for (const auto& [fact, value] : results.machine) {
        rows += element("tr", element("th", escaped(fact)) + element("td", escaped(value))) + "\n";
    }
    return rows.empty() ? "" : "<h2>Machine</h2>\n<table>" + rows + "</table>\n";
}

std::string summaryRow(const Quantity& each) {
    const std::string verdict = verdictText(each);
    const std::string aim =
        escaped(aimText(each)) + " <span class=\"" + verdict + "\">" + verdict + "</span>";
    return "<tr>" + element("td", escaped(each.what)) +
           element("td class=\"n\"", escaped(valueText(each))) +
           element("td", escaped(baselineText(each))) +
           element("td class=\"n\"", escaped(ratioText(each))) +
           element("td class=\"aim\"", verdict.empty() ? "" : aim) +
           element("td", escaped(each.paper)) + "</tr>\n";
}

std::string summary(const Results& results) {
    if (results.quantities.empty()) return "<p>Nothing was measured.</p>\n";
    std::string text =
        "<h2>Summary</h2>\n<table><thead><tr><th>What</th><th class=\"n\">Here</th><th>Beside it"
        "</th><th class=\"n\">Ratio</th><th>Aim</th><th>Paper</th></tr></thead>\n";
    std::string group;
    for (const Quantity& each : results.quantities) {
        if (each.group != group) {
            group = each.group;
            text +=
                "<tr class=\"group\">" + element("th colspan=\"6\"", escaped(group)) + "</tr>\n";
        }
        text += summaryRow(each);
    }
    return text + "</table>\n";
}

std::string figures(const Results& results, const std::vector<std::string>& pictures) {
    const std::vector<std::string> files = figureFiles(results);
    std::string contents, sections;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Figure& each = results.figures[i];
        contents += "<li><a href=\"#" + files[i] + "\">" + escaped(each.title) + "</a></li>\n";
        sections += "<section id=\"" + files[i] + "\">" + element("h3", escaped(each.title)) +
                    "\n" +
                    (pictures[i].empty() ? "<p>There is no picture of it.</p>\n" : pictures[i]);
        if (!each.paper.empty()) sections += element("p", "<b>Paper:</b> " + escaped(each.paper));
        if (!each.setup.empty()) sections += element("p", "<b>Here:</b> " + escaped(each.setup));
        sections += "<details><summary>Values, " + files[i] + ".csv</summary>" +
                    element("pre", escaped(figureCsv(each))) + "</details></section>\n";
    }
    if (files.empty()) return {};
    return "<h2>Figures</h2>\n<nav><ul>\n" + contents + "</ul></nav>\n" + sections;
}

}  // namespace

std::string htmlReport(const Results& results, const std::vector<std::string>& pictures) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<title>CorteX profiler, " +
           escaped(results.started) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n" +
           head(results) + machine(results) + summary(results) + figures(results, pictures) +
           "</body>\n</html>\n";
}

}  // namespace cortex::profiler
