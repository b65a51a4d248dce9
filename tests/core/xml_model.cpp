// SPDX-License-Identifier: Apache-2.0
#include "core/xml_model.hpp"

#include "core/model_folder.hpp"

namespace cortex::test {

namespace {

void shorten(std::string& text, const std::string& folder) {
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
        text.erase(at, folder.size());
    }
}

}  // namespace

XmlModel readFiles(const std::vector<std::pair<std::string, std::string>>& files) {
    const ModelFolder folder;
    for (const auto& [name, text] : files) {
        create_directories((folder.path() / name).parent_path());
        folder.write(name, text);
    }
    const std::filesystem::path first = folder.path() / files.front().first;
    XmlModel model;
    model.files = readModelFiles(std::span{&first, 1}, model.report);
    const std::string prefix = folder.path().string() + "/";
    for (Finding& finding : model.report.findings) {
        shorten(finding.place.file, prefix);
        shorten(finding.message, prefix);
        shorten(finding.remedy, prefix);
    }
    return model;
}

XmlModel readTypes(const std::string& types, const std::string& rules) {
    return readFiles(
        {{"m.xml", "<morphology name='m'><include file='t.xml'/>" + rules + "</morphology>"},
         {"t.xml", "<ontology name='t'>" + types + "</ontology>"}});
}

testing::AssertionResult finds(const XmlModel& model, const std::string& rule,
                               const std::string& path, int line, const std::string& words) {
    const auto& findings = model.report.findings;
    if (findings.size() != 1) {
        return testing::AssertionFailure() << findings.size() << " findings:\n" << model.text();
    }
    const Finding& found = findings.front();
    if (found.rule != rule || found.path != path || found.place.line != line ||
        found.severity != Severity::Error || found.remedy.empty() ||
        found.text().find(words) == std::string::npos) {
        return testing::AssertionFailure() << found.rule << ": " << found.text();
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult isValid(const XmlModel& model) {
    if (model.report.findings.empty()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << model.text();
}

}  // namespace cortex::test
