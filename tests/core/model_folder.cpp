// SPDX-License-Identifier: Apache-2.0
#include "core/model_folder.hpp"

#include "cortex/core/validation.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <stdlib.h>

namespace cortex::test {

ModelFolder::ModelFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cortex-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

ModelFolder::~ModelFolder() { std::filesystem::remove_all(path_); }

std::filesystem::path ModelFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream{path_ / name} << text;
    return path_ / name;
}

std::string ModelFolder::read(const std::string& name) const { return textOf(path_ / name); }

void ModelFolder::copyOntology() const {
    const std::filesystem::path source{CORTEX_SOURCE_DIR "/ontology"};
    for (const auto& entry : std::filesystem::directory_iterator{source}) {
        const auto extension = entry.path().extension();
        if (extension != ".xml" && extension != ".xsd") continue;
        std::filesystem::copy_file(entry.path(), path_ / entry.path().filename());
    }
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream{file};
    if (!stream) throw std::runtime_error("cannot read " + file.string());
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::string caseStudy() {
    const std::filesystem::path folder{CORTEX_SOURCE_DIR "/examples/lbr_teleop"};
    std::string text = textOf(folder / "lbr_teleop.xml");
    const std::regex include{"  <include file=\"(\\w+\\.xml)\"/>\n"};
    for (std::smatch match; std::regex_search(text, match, include);) {
        const std::string part = textOf(folder / match[1].str());
        const auto types = part.find("  <morphology");
        const bool known = text.find("<morphology") != std::string::npos;
        const auto begin = known ? part.find('\n', types) + 1 : types;
        const auto place = static_cast<std::size_t>(match.position());
        const auto length = static_cast<std::size_t>(match.length());
        text.replace(place, length, part.substr(begin, part.find("</system>") - begin));
    }
    return text;
}

const Finding* CheckedModel::find(const std::string& rule) const {
    const auto found = std::ranges::find(report.findings, rule, &Finding::rule);
    return found != report.findings.end() ? &*found : nullptr;
}

std::size_t CheckedModel::count(const std::string& rule) const {
    return static_cast<std::size_t>(std::ranges::count(report.findings, rule, &Finding::rule));
}

namespace {

// Places as if the folder were the working folder.
void shorten(Report& report, const std::string& folder) {
    for (Finding& finding : report.findings) {
        for (std::string* text : {&finding.place.file, &finding.message, &finding.remedy}) {
            for (std::size_t at; (at = text->find(folder)) != std::string::npos;) {
                text->erase(at, folder.size());
            }
        }
    }
}

}  // namespace

CheckedModel check(const std::filesystem::path& file) {
    CheckedModel checked;
    ModelFiles files = readModelFiles(std::array{file}, checked.report);
    checked.tree = std::make_unique<SimplexTree>(std::move(files.types));
    checked.tree->add(files.system, nullptr, checked.report);
    checked.tree->createRelated();
    checked.report.append(validate(*checked.tree));
    shorten(checked.report, file.parent_path().string() + "/");
    return checked;
}

namespace {

const char* const smallModel = R"(<ontology name="small" version="1.0">
  <type name="Active" abstract="true" role="active">
    <data name="state" kind="int"/>
    <data name="faultCode" kind="int"/>
    <data name="taskTime" kind="float" measured="true"/>
  </type>
  <type name="Activity" abstract="true" role="active">
    <data name="progress" kind="float"/>
  </type>
  <type name="Agent" extends="Activity"/>
  <type name="Concept" abstract="true"/>
  <type name="Axis" extends="Concept">
    <data name="position" kind="float" unit="rad" min="-3" max="3" safe="observed"/>
    <data name="velocity" kind="float" unit="rad/s" safe="0"/>
    <data name="mode" kind="int" labels="0:Off 1:On" safe="0"/>
    <data name="note" kind="string" capacity="8" safe="hold"/>
    <data name="direction" kind="float" length="3" min="-1" max="1" default="0 0 1" constant="true"/>
  </type>
  <type name="Axis1" extends="Axis"/>
  <type name="Axis2" extends="Axis"/>
  <type name="SharedAxis" extends="Axis" writers="many"/>
  <type name="Lamp" extends="Concept">
    <data name="on" kind="bool"/>
  </type>
  <type name="Controller" extends="Active">
    <data name="gain" kind="float" min="0" max="10" settable="always"/>
  </type>
  <type name="Blind" extends="Active" abstract="true"/>
  <type name="BlindController" extends="Blind"/>
  <type name="Switch" extends="Active"/>
  <type name="Device" extends="Active" measures="true"/>
  <type name="Tool" extends="Concept" abstract="true"/>
  <type name="TwoFinger" extends="Tool"/>
  <type name="Welder" extends="Tool"/>
  <type name="Arm" extends="Concept"/>
  <type name="Three" extends="Concept"/>
  <type name="Nest" extends="Concept"/>
  <type name="Maker" extends="Active" abstract="true"/>
  <type name="Painter" extends="Maker"/>
  <type name="Pair" extends="Active"/>
  <type name="Watcher" extends="Active"/>
  <type name="Slide" extends="Concept">
    <data name="position" kind="float" unit="mm" safe="hold"/>
    <data name="turn" kind="float" unit="rad" safe="hold"/>
  </type>
  <type name="Lift" extends="Concept">
    <data name="position" kind="float" unit="m" safe="hold"/>
    <data name="turn" kind="float" unit="1" safe="hold"/>
  </type>
  <type name="Mover" extends="Active"/>
  <type name="Guard" extends="Active"/>
  <type name="Drive" extends="Device"/>
  <type name="Shown" extends="Concept"/>
</ontology>
)";

const char* const smallRules = R"(<morphology name="small">
  <include file="small.xml"/>
  <rules type="Controller">
    <relationship name="axes" direction="input" target="Axis"/>
    <relationship name="demands" direction="output" target="Axis" counterpart="axes"/>
  </rules>
  <rules type="Blind">
    <relationship name="demands" direction="output" target="Axis" max="2"/>
  </rules>
  <rules type="BlindController">
    <relationship name="third" direction="output" target="Axis" max="2" refines="demands"/>
  </rules>
  <rules type="Switch">
    <relationship name="lamps" direction="output" target="Lamp"/>
    <relationship name="before" direction="input" target="Active"/>
    <relationship name="watched" direction="input" target="Concept"/>
  </rules>
  <rules type="Device">
    <relationship name="demand" direction="input" target="Axis" max="1"/>
    <relationship name="observation" direction="output" target="Axis" max="1" delayed="true"/>
  </rules>
  <rules type="Arm">
    <relationship name="tool" direction="input" target="Tool" min="1" max="1"/>
  </rules>
  <rules type="Three">
    <relationship name="axes" direction="input" target="Axis" min="3" max="4" create="Axis1 Axis2"/>
    <relationship name="base" direction="input" target="Axis" min="1" max="1" create="Axis"/>
  </rules>
  <rules type="Nest">
    <relationship name="inner" direction="input" target="Nest" min="1" max="1" create="Nest"/>
  </rules>
  <rules type="Maker">
    <relationship name="outputs" direction="output" target="Concept" min="2" delayed="true"/>
  </rules>
  <rules type="Painter">
    <relationship name="lights" direction="output" target="Lamp" delayed="true"/>
  </rules>
  <rules type="Pair">
    <relationship name="left" direction="output" target="Concept" delayed="true"/>
    <relationship name="right" direction="output" target="Concept" delayed="true"/>
    <relationship name="ask" direction="output" target="Active"/>
    <relationship name="tell" direction="output" target="Active"/>
  </rules>
  <rules type="Watcher">
    <relationship name="seen" direction="input" target="Concept" maxAge="0.004"/>
  </rules>
  <rules type="Mover">
    <relationship name="seen" direction="input" target="Concept"/>
    <relationship name="moved" direction="output" target="Concept" sameCount="seen"/>
    <relationship name="other" direction="input" target="Concept"/>
  </rules>
  <rules type="Guard">
    <relationship name="guarded" direction="input" target="Concept" onLoss="safe"/>
    <relationship name="made" direction="output" target="Concept"/>
  </rules>
  <rules type="Drive">
    <relationship name="demands" direction="input" target="Axis"/>
  </rules>
  <rules type="Shown">
    <relationship name="axes" direction="output" target="Axis"/>
  </rules>
</morphology>
)";

std::filesystem::path writeSmall(const ModelFolder& folder) {
    folder.write("small.xml", smallModel);
    return folder.write("small-morphology.xml", smallRules);
}

}  // namespace

TypeModel smallTypes() {
    const ModelFolder folder;
    return TypeModel::load(writeSmall(folder));
}

CheckedModel checkSmall(const std::string& elements) {
    const ModelFolder folder;
    writeSmall(folder);
    return check(folder.write("system.xml",
                              "<system name=\"test\">\n"
                              "<morphology file=\"small-morphology.xml\"/>\n" +
                                  elements + "</system>\n"));
}

Finding only(const CheckedModel& checked) {
    if (checked.report.findings.size() == 1) return checked.report.findings.front();
    return {Severity::Info, "", "", {}, checked.report.text(), ""};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string simplex(const std::string& path, const std::string& type, const std::string& inside,
                    const std::string& attributes) {
    return "<simplex path=\"" + path + "\" type=\"" + type + "\" " + attributes + ">\n" + inside +
           "</simplex>\n";
}

std::string relate(const std::string& rule, const std::string& to, const std::string& more) {
    return "<relate rule=\"" + rule + "\" to=\"" + to + "\" " + more + "/>\n";
}

std::string set(const std::string& item, const std::string& value) {
    return "<set data=\"" + item + "\" value=\"" + value + "\"/>\n";
}

}  // namespace cortex::test
