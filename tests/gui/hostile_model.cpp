// SPDX-License-Identifier: Apache-2.0
#include "gui/hostile_model.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

const std::vector<std::string>& phrases() {
    static const std::vector<std::string> all{
        "<b>SAFE</b>",
        "<img src=x>",
        "<img src=\"file:///none.png\"/>",
        "<a href=\"file:///\">go on</a>",
        "<h1>all axes at rest</h1>",
        "<!DOCTYPE html><html><body bgcolor=red>",
        "<table><tr><td>1</td></tr></table>",
        "<qt>quiet</qt>",
        "&amp; &lt;b&gt; &#0; && &",
        "%1 %2 %n %L1 %99 %%",
        "\n",
        "\r\n",
        "\t",
        "\x01\x02\x07\x08\x1b[31m\x7f",
        "\u202E\u2066reversed\u202C",      // written from the right
        "\u200F\u200E\u061C",              // marks of direction
        "\u0301\u0301\u0301\u0301",        // accents on nothing
        "\u2028\u2029\u0085",              // ends of lines and paragraphs
        "\uFFFD\uFFFE\uFFFF\uFEFF",        // what stands for wrong octets, no characters
        "\U0010FFFF\U0001F600\U000E0001",  // beyond 16 bits
        "\u05D0\u05D1 \u0645\u0631\u062D\u0628\u0627",  // written from the right by itself
        "limited from -1.5e308 to 99999999999999999999",
        "'\"\\`$(reboot)",
        "is:AxisConcept state:Fault",
        "[1.5]"};
    return all;
}

constexpr std::size_t mostOfDescription = 4096;  // octets, as the rules of types ask

// At most so many octets, with whole characters.
std::string cut(std::string text, std::size_t most) {
    if (text.size() <= most) return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
    text.resize(most);
    return text;
}

}  // namespace

HostileModel::HostileModel(unsigned seed) : random_{seed} {
    TypeModel model = types();
    const auto made = [this](SimplexTree& tree) { fill(tree); };
    agent_ = std::make_unique<MadeAgent>("robot", made, std::move(model));
}

std::string HostileModel::text() {
    std::string result;
    for (int i = number(1, 5); i > 0; --i) {
        result += phrases()[random_() % phrases().size()];
        if (often(50)) result += ' ';
    }
    if (often(5)) {  // a long line, with blanks or without
        const std::string again = often(50) ? "<i>long</i>" : "longer ";
        while (result.size() < 10'000) result += again;
    }
    return result;
}

// One word, as the rules of types ask.
std::string HostileModel::label() {
    std::string word;
    for (const char c : text()) {
        if (c != ' ' && c != '\t' && c != '\r' && c != '\n') word += c;
    }
    return cut(word, 200);
}

DataItem HostileModel::item(const std::string& name, bool safe) {
    static const std::array units{"", "m", "rad", "us", "%", "deg", "m/s2", "N.m", "Cel"};
    static const std::array formats{"", "%.3f", "%.17f", "%.0f"};
    DataItem made;
    made.name = name;
    made.kind = static_cast<Kind>(number(0, 3));
    made.length = often(70) ? 1 : static_cast<std::uint32_t>(number(2, 7));
    made.description = cut(text(), mostOfDescription);
    if (made.kind == Kind::String) made.capacity = static_cast<std::uint32_t>(number(1, 90));
    if (made.kind == Kind::Float) {
        made.unit = units[random_() % units.size()];
        made.format = formats[random_() % formats.size()];
        if (often(40)) made.min = Number{-1.0 * number(0, 9)};
        if (often(40)) made.max = Number{1.0 * number(0, 9)};
    }
    if (made.kind == Kind::Int && often(60)) {
        for (int i = number(1, 9); i > 0; --i)
            made.labels[i] = "L" + std::to_string(i) + label();  // each another one
    } else if (made.kind == Kind::Int) {
        if (often(40)) made.min = Number{std::int64_t{-1} * number(0, 9)};
        if (often(40)) made.max = Number{std::int64_t{1} * number(0, 9)};
    }
    if (safe && often(50)) made.settable = StateSet::always();
    if (safe) made.safe.kind = Safe::Kind::Hold;
    return made;
}

TypeModel HostileModel::types() {
    static const TypeModel base = TypeModel::load(CORTEX_SOURCE_DIR "/ontology/base.xml");
    std::vector<TypeDeclaration> declarations;
    for (const auto& [name, declaration] : base.declarations()) {
        declarations.push_back(declaration);
    }
    for (int i = number(2, 8); i > 0; --i) {
        const bool isConcept = i == 1 || (i > 2 && often(50));
        TypeDeclaration type;
        type.name = (isConcept ? "Concept" : "Processor") + std::to_string(i);
        std::vector<std::string>& kin = isConcept ? concepts_ : processors_;
        const std::string parent = isConcept ? "Concept" : "Processor";
        type.parents = {kin.empty() || often(60) ? parent : kin[random_() % kin.size()]};
        kin.push_back(type.name);
        type.version = "1.0";
        type.description = cut(text(), mostOfDescription);
        for (int j = number(0, 8); j > 0; --j) {
            type.data.push_back(
                item("item" + std::to_string(i) + "_" + std::to_string(j), isConcept));
        }
        for (int j = isConcept ? 0 : number(0, 3); j > 0; --j) {
            Command command;
            command.name = "command" + std::to_string(i) + "_" + std::to_string(j);
            command.description = cut(text(), mostOfDescription);
            command.available = StateSet::always();
            command.confirm = often(30);
            command.stops = often(30);
            command.repeated = often(30);
            command.onInputLost = often(30) ? OnInputLost::Continue : OnInputLost::Fail;
            for (int k = number(0, 5); k > 0; --k) {
                command.request.push_back(item("given" + std::to_string(k), false));
            }
            type.commands.push_back(command);
        }
        if (type.parents.front() == "Processor") {
            for (const Direction direction : {Direction::Input, Direction::Output}) {
                Rule rule;
                rule.name =
                    (direction == Direction::Input ? "reads" : "writes") + std::to_string(i);
                rule.direction = direction;
                rule.target = "Concept";
                rule.description = cut(text(), mostOfDescription);
                type.rules.push_back(rule);
            }
        }
        declarations.push_back(type);
    }
    Report report;
    TypeModel model = TypeModel::build(std::move(declarations), report);
    EXPECT_TRUE(report.ok()) << "a hostile type is to be one that is allowed: " << report.text();
    return model;
}

// Up to 8 levels deep.
std::string HostileModel::path(const std::string& name) {
    std::string result;
    for (int level = number(0, 7); level > 0; --level)
        result += "/level" + std::to_string(number(1, 3));
    return result + '/' + name;
}

void HostileModel::fill(SimplexTree& tree) {
    std::vector<Simplex*> data;
    const int count = number(1, 30);
    for (int i = 0; i < count; ++i) {
        const bool isConcept = often(60);
        const auto& of = isConcept ? concepts_ : processors_;
        paths_.push_back(path((isConcept ? "concept" : "processor") + std::to_string(i)));
        Simplex& simplex = tree.add(paths_.back(), of[random_() % of.size()]);
        if (isConcept) {
            data.push_back(&simplex);
            continue;
        }
        for (const Rule& rule : simplex.type().rules) {
            for (Simplex* each : data) {
                if (often(20)) tree.relate(simplex, rule.name, *each, often(50));
            }
        }
    }
}

void HostileModel::setValues() {
    const Structure& structure = *agent_->structure;
    for (const std::string& path : paths_) {
        const auto& layout = *structure.simplexes[agent_->at(path)].layout;
        for (const DataItem& each : layout.type->data) {
            const ItemLayout* at = layout.find(each.name);
            if (at == nullptr || each.constant || each.length != 1 || often(20)) continue;
            if (each.kind == Kind::Int) agent_->put(path, each.name, std::int64_t{number(-1, 9)});
            if (each.kind == Kind::Float) agent_->put(path, each.name, number(-90, 90) * 1e5);
            if (each.kind == Kind::String) agent_->put(path, each.name, cut(text(), each.capacity));
        }
        if (layout.type->active()) agent_->put(path, "state", std::int64_t{number(0, 4)});
        agent_->degrade(path, static_cast<Quality>(number(0, 3)));
    }
}

std::shared_ptr<gui::Frame> HostileModel::frame() {
    setValues();
    gui::AgentFrame robot = agent_->now(often(70) ? "running" : "lost");
    robot.status.host = text();
    robot.status.trouble = text();
    robot.status.security = text();
    robot.status.dropped = text();
    robot.status.refused = text();
    if (often(30)) robot.status.standstill = text();
    const auto made = frameOf({robot});
    made->problem.clear();
    made->control.notice = text();
    made->security = text();
    return made;
}

std::vector<comms::AgentEvent> HostileModel::events(std::size_t count) {
    static const std::array severities{Severity::Info, Severity::Warning, Severity::Error};
    std::vector<comms::AgentEvent> made;
    for (std::size_t i = 0; i < count; ++i) {
        comms::AgentEvent event;
        event.agent = "robot";
        event.epoch = agent_->structure->epoch;
        event.number = lastEvent_ += often(10) ? 2 : 1;  // some do not come
        event.cycle = static_cast<std::int64_t>(event.number);
        event.wallClock = event.cycle * 1'000'000;
        event.severity = severities[random_() % severities.size()];
        event.kind = often(50) ? "message" : phrases()[random_() % phrases().size()];
        event.path = often(80) ? paths_[random_() % paths_.size()] : std::string{};
        event.text = text();
        made.push_back(event);
    }
    return made;
}

}  // namespace cortex::test
