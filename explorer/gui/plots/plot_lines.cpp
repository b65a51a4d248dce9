// SPDX-License-Identifier: Apache-2.0
#include "plots/plot_lines.hpp"

#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "style/look.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace cortex::gui {

namespace {

constexpr int seriesCount = 8;

std::string lastName(const std::string& path) { return path.substr(path.rfind('/') + 1); }

QVector<double> dashesOf(const PlotLine& line) {
    if (line.demand) return {5, 3};
    switch (line.colour % seriesCount) {
        case 4:
            return {8, 3};
        case 5:
            return {8, 3, 2, 3};
        case 6:
            return {3, 3};
        case 7:
            return {12, 3};
        default:
            return {};
    }
}

}  // namespace

QString PlotLine::itemName() const {
    QString text = plainText(item.item);
    if (data.length > 1 || item.element > 0) text += QStringLiteral("[%1]").arg(item.element);
    return text;
}

QString PlotLine::name() const { return plainText(item.path) + '.' + itemName(); }

QString PlotLine::unit() const { return unitText(data.unit); }

QPen PlotLine::pen(double width) const {
    const auto index = static_cast<std::size_t>(colour % seriesCount);
    QPen pen{Look::colours().series[index], width};
    pen.setJoinStyle(Qt::RoundJoin);
    pen.setCapStyle(Qt::FlatCap);
    if (const auto dashes = dashesOf(*this); !dashes.isEmpty()) pen.setDashPattern(dashes);
    return pen;
}

void AxisTitle::add(const PlotLine& line) {
    const QString name = plainText(line.item.item);
    if (!names_.contains(name)) names_.append(name);
    unit_ = line.unit();
}

QString AxisTitle::text() const {
    if (names_.isEmpty()) return {};
    const QString text = names_.join(QStringLiteral(", "));
    return unit_.isEmpty() ? text : QStringLiteral("%1 (%2)").arg(text, unit_);
}

QString PlotLines::titleOf(int panel) const {
    QStringList titles;
    for (const bool right : {false, true}) {
        AxisTitle title;
        for (const PlotLine& each : lines_) {
            if (each.panel == panel && each.right == right) title.add(each);
        }
        if (!title.text().isEmpty()) titles.append(title.text());
    }
    return titles.join(QStringLiteral(", "));
}

int PlotLines::panels() const {
    int last = -1;
    for (const PlotLine& each : lines_) last = std::max(last, each.panel);
    return last + 1;
}

const PlotLine* PlotLines::find(int tag) const {
    const auto found = std::ranges::find(lines_, tag, &PlotLine::tag);
    return found == lines_.end() ? nullptr : &*found;
}

bool PlotLines::add(const RecordedItem& item, int panel) {
    const bool there = std::ranges::any_of(lines_, [&](const PlotLine& each) {
        return each.item.path == item.path && each.item.item == item.item &&
               each.item.element == item.element;
    });
    if (there) return false;
    PlotLine line;
    line.item = item;
    line.item.agent.clear();
    line.wish = panel;
    std::set<int> colours;
    for (const PlotLine& each : lines_) {
        line.tag = std::max(line.tag, each.tag + 1);
        colours.insert(each.colour);
    }
    while (colours.contains(line.colour)) ++line.colour;
    lines_.push_back(std::move(line));
    return true;
}

bool PlotLines::remove(int tag) {
    const bool removed = std::erase_if(lines_, [&](const auto& each) { return each.tag == tag; });
    closeUp();
    return removed;
}

bool PlotLines::fits(const PlotLine& line, int panel, bool right) const {
    bool used = false;
    for (const PlotLine& each : lines_) {
        if (&each == &line || each.panel != panel || each.right != right) continue;
        used = true;
        if (each.data.unit != line.data.unit) return false;
    }
    return used || !right;
}

// Whether the right axis of the panel is free, or has its unit.
bool PlotLines::mayBeRight(const PlotLine& line, int panel) const {
    return std::ranges::none_of(lines_, [&](const PlotLine& each) {
        return &each != &line && each.panel == panel && each.right &&
               each.data.unit != line.data.unit;
    });
}

void PlotLines::place(PlotLine& line, int wish) {
    line.panel = -1;
    const int count = panels();
    for (int panel = 0; panel < count && wish < 0; ++panel) {
        if (fits(line, panel, false)) wish = panel;
    }
    const bool taken = wish >= 0 && !fits(line, wish, false) && !mayBeRight(line, wish);
    line.panel = wish >= 0 && !taken ? std::min(wish, count) : std::min(count, mostPanels - 1);
    line.right = line.panel < count && !fits(line, line.panel, false);
}

bool PlotLines::open(int panel) {
    if (panels() >= mostPanels) return false;
    for (PlotLine& each : lines_) {
        if (each.panel >= panel) ++each.panel;
        if (each.wish >= panel) ++each.wish;
    }
    return true;
}

bool PlotLines::move(int tag, int panel, bool anew) {
    const auto found = std::ranges::find(lines_, tag, &PlotLine::tag);
    if (found == lines_.end() || found->lane || panel >= mostPanels) return false;
    if (anew ? !open(panel) : panel == found->panel) return false;
    std::set<std::string> units{found->data.unit};
    for (const PlotLine& each : lines_) {
        if (each.panel == panel) units.insert(each.data.unit);
    }
    if (units.size() > 2) return false;
    place(*found, panel);
    closeUp();
    return true;
}

void PlotLines::closeUp() {
    for (int panel = panels() - 1; panel >= 0; --panel) {
        const auto in = [&](const PlotLine& each) { return each.panel == panel; };
        if (std::ranges::any_of(lines_, in)) {
            // What is alone with its unit has the left axis.
            const bool left = std::ranges::any_of(
                lines_, [&](const PlotLine& each) { return in(each) && !each.right; });
            for (PlotLine& each : lines_) each.right = each.right && (!in(each) || left);
            continue;
        }
        for (PlotLine& each : lines_) each.panel -= each.panel > panel ? 1 : 0;
    }
}

void PlotLines::convert(PlotLine& line) const {
    const auto shown = units_.of(line.model);
    line.data = shown ? shown->item : line.model;
    line.factor = shown ? shown->factor : 1;
}

void PlotLines::setUnits(const ShownUnits& units) {
    if (units == units_) return;
    units_ = units;
    for (PlotLine& each : lines_) convert(each);
    for (auto line = lines_.begin(); line != lines_.end(); ++line) {
        const bool alone = std::none_of(lines_.begin(), line, [&](const PlotLine& before) {
            return before.panel >= 0 && before.panel == line->panel &&
                   before.right == line->right && before.data.unit != line->data.unit;
        });
        if (!alone) place(*line);
    }
    closeUp();
}

bool PlotLines::learn(const Frame& frame) {
    bool learnt = false;
    for (PlotLine& each : lines_) {
        const auto place = frame.find(each.item.path);
        if (!place) continue;
        const std::string& agent = frame.agents[place->agent].status.name;
        if (each.known && each.item.agent == agent) continue;
        const SimplexInfo& info = frame.info(*place);
        const ItemLayout* layout = info.layout->find(each.item.item);
        if (layout == nullptr || each.item.element >= layout->item->length) continue;
        each.item.agent = agent;
        each.model = *layout->item;
        convert(each);
        each.demand = info.role == Role::Modification;
        each.lane = each.data.kind == Kind::Bool || each.data.kind == Kind::String ||
                    !each.data.labels.empty();
        each.known = learnt = true;
        if (each.lane) continue;
        // A demand has the colour of what is observed of it.
        for (const PlotLine& other : lines_) {
            if (other.known && other.demand != each.demand && other.item.item == each.item.item &&
                lastName(other.item.path) == lastName(each.item.path)) {
                each.colour = other.colour;
            }
        }
        this->place(each, each.wish);
    }
    return learnt;
}

std::vector<RecordedItem> PlotLines::recorded() const {
    std::vector<RecordedItem> result;
    for (const PlotLine& each : lines_) {
        if (each.known) result.push_back(each.item);
    }
    return result;
}

}  // namespace cortex::gui
