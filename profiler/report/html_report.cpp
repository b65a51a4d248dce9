// SPDX-License-Identifier: Apache-2.0
#include "report/html_report.hpp"

#include "report/html_style.hpp"
#include "report/number_text.hpp"
#include "report/quantity_text.hpp"
#include "report/results_files.hpp"
#include "report/svg_plot.hpp"

namespace cortex::profiler {
namespace {

constexpr std::string_view thinSpace = "\u202F";  // between groups of digits

std::string element(const std::string& name, const std::string& inner) {
    return "<" + name + ">" + inner + "</" + name.substr(0, name.find(' ')) + ">";
}

std::string list(const std::vector<std::string>& entries) {
    if (entries.empty()) return {};
    std::string text;
    for (const std::string& entry : entries) text += element("li", escaped(entry)) + "\n";
    return "<ul>\n" + text + "</ul>\n";
}

std::string head(const Results& results) {
    std::string text = "<h1>CorteX profiler</h1>\n<p class=\"faint\">" + escaped(results.started);
    if (!results.version.empty()) text += " · CorteX " + escaped(results.version);
    if (!results.command.empty()) text += " · <code>" + escaped(results.command) + "</code>";
    text += "</p>\n";
    const Aims aims = aimsOf(results);
    if (aims.all > 0) {
        text += "<p>Aims met: <span class=\"" + std::string{aims.missed.empty() ? "good" : "bad"} +
                "\">" + std::to_string(aims.all - aims.missed.size()) + " of " +
                std::to_string(aims.all) + "</span>" +
                (aims.missed.empty() ? ".</p>\n" : "; not met:</p>\n") + list(aims.missed);
    }
    if (!results.complete) {
        text +=
            "<div class=\"box warn\"><b>Not complete.</b> The run was stopped, or still goes on: "
            "below is what it had measured.</div>\n";
    }
    return text;
}

std::string notes(const Results& results) {
    if (results.notes.empty()) return {};
    return "<div class=\"box\"><b>To be known when reading this</b>" + list(results.notes) +
           "</div>\n";
}

std::string machine(const Results& results) {
    if (results.machine.empty()) return {};
    std::string text = "<h2>Machine</h2>\n<dl class=\"machine\">\n";
    for (const auto& [fact, value] : results.machine) {
        text += element("div", element("dt", escaped(fact)) + element("dd", escaped(value))) + "\n";
    }
    return text + "</dl>\n";
}

std::string aimCell(const Quantity& quantity) {
    const std::optional<bool> reached = met(quantity);
    if (!reached) return element("td", "");
    const std::string aim = escaped(aimText(quantity, thinSpace));
    return element("td class=\"aim\"", aim + (*reached ? " <span class=\"good\">✓ met</span>"
                                                       : " <span class=\"bad\">✗ not met</span>"));
}

std::string summary(const Results& results) {
    if (results.quantities.empty()) return {};
    std::string text =
        "<h2>Summary</h2>\n<div class=\"wide\"><table>\n<thead><tr><th>What</th>"
        "<th class=\"n\">Here</th><th class=\"base\">Beside it</th><th class=\"n\">Ratio</th>"
        "<th>Aim</th><th>Paper</th></tr></thead>\n<tbody>\n";
    for (const Quantity& each : results.quantities) {
        std::string repeats;
        if (each.repeats.size() > 1) {
            repeats = " title=\"of " + std::to_string(each.repeats.size()) + " repeats\"";
        }
        text += "<tr>" + element("td", escaped(each.what)) +
                element("td class=\"n\"" + repeats, escaped(valueText(each, thinSpace))) +
                element("td class=\"base\"", escaped(baselineText(each, thinSpace))) +
                element("td class=\"n\"", escaped(ratioText(each))) + aimCell(each) +
                element("td class=\"paper\"", escaped(each.paper)) + "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
}

std::string figure(const Figure& figure, const std::string& file) {
    const Plot plot = plotOf(figure);
    std::string text = "<figure id=\"" + escaped(file) + "\">\n" +
                       element("h3", escaped(figure.title)) + "\n<div class=\"beside\"><div>" +
                       plot.svg + "<ul class=\"legend\">\n" + plot.legend + "</ul>\n";
    for (const std::string& note : plot.notes) text += element("p class=\"said\"", escaped(note));
    text += "</div><aside>";
    if (!figure.paper.empty()) text += "<h4>Paper</h4>" + element("p", escaped(figure.paper));
    if (!figure.setup.empty()) text += "<h4>Here</h4>" + element("p", escaped(figure.setup));
    return text + "<h4>Values</h4><p><a href=\"" + escaped(file) + ".csv\">" + escaped(file) +
           ".csv</a></p></aside></div>\n</figure>\n";
}

std::string figures(const Results& results) {
    if (results.figures.empty()) return {};
    const std::vector<std::string> files = figureFiles(results);
    std::string contents, plots;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Figure& each = results.figures[i];
        contents +=
            "<li><a href=\"#" + escaped(files[i]) + "\">" + escaped(each.title) + "</a></li>\n";
        plots += figure(each, files[i]);
    }
    const std::string list = files.size() > 2 ? "<nav><ul>\n" + contents + "</ul></nav>\n" : "";
    return "<h2>Figures</h2>\n" + list + plots;
}

}  // namespace

std::string htmlReport(const Results& results) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
           "<meta name=\"color-scheme\" content=\"light dark\">\n<title>CorteX profiler, " +
           escaped(results.started) + "</title>\n<style>" + htmlStyle +
           "</style>\n</head>\n<body>\n" + head(results) + notes(results) + machine(results) +
           summary(results) + figures(results) + "</body>\n</html>\n";
}

}  // namespace cortex::profiler
