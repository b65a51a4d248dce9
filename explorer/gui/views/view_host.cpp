// SPDX-License-Identifier: Apache-2.0
#include "views/view_host.hpp"

#include "cortex/core/nearest_names.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/value_text.hpp"
#include "views/base_view.hpp"
#include "views/held_button.hpp"
#include "views/run_question.hpp"

#include <QApplication>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds untilItEnds = std::chrono::hours{24};

// What an order concerns in a frame, and when it can be given; or why there is no such thing.
struct Found {
    std::optional<Place> place;
    StateSet available = StateSet::always();
    const Command* command = nullptr;  // null also for `set`
    QString why;
};

QString noSuch(const QString& what, const std::string& path, const std::string& name,
               const std::vector<std::string>& names) {
    return ViewHost::tr("%1 has no %2 %3; %4")
        .arg(QString::fromStdString(path), what, QString::fromStdString(name),
             QString::fromStdString(nearestNames(name, names)));
}

// All items that are set together must be settable.
void findItems(const Type& type, const explorer::Order& order, Found& found) {
    for (const auto& [name, value] : order.arguments) {
        const auto item = std::ranges::find(type.data, name, &DataItem::name);
        if (item != type.data.end()) {
            found.available = found.available & item->settable;
            continue;
        }
        std::vector<std::string> names;
        for (const DataItem& each : type.data) names.push_back(each.name);
        found.why = noSuch(ViewHost::tr("item"), order.path, name, names);
    }
}

Found findOrder(const Frame& frame, const explorer::Order& order) {
    Found found;
    found.place = frame.find(order.path);
    if (!found.place) {
        found.why = ViewHost::tr("%1 is not heard").arg(QString::fromStdString(order.path));
        return found;
    }
    const Type& type = frame.type(*found.place);
    if (order.command == "set") {
        findItems(type, order, found);
        return found;
    }
    if (order.command == "cancel" && type.isA("Activity")) return found;  // agents have it
    const auto each = std::ranges::find(type.commands, order.command, &Command::name);
    if (each != type.commands.end()) {
        found.command = &*each;
        found.available = each->available;
        return found;
    }
    std::vector<std::string> names;
    for (const Command& command : type.commands) names.push_back(command.name);
    found.why = noSuch(ViewHost::tr("command"), order.path, order.command, names);
    return found;
}

// The page of a simplex that this widget is on; null: none.
BaseView* pageOf(const QWidget& widget) {
    for (QWidget* each = widget.parentWidget(); each != nullptr; each = each->parentWidget()) {
        if (auto* page = qobject_cast<BaseView*>(each)) return page;
    }
    return nullptr;
}

QString whyNotNowOf(const Frame& frame, const Found& found, const explorer::Order& order) {
    return found.why.isEmpty()
               ? whyNotNow(frame, *found.place, found.available, order.command, order.arguments)
               : found.why;
}

}  // namespace

ViewHost::ViewHost(Commands& commands, QObject* parent) : QObject{parent}, commands_{commands} {}

QString ViewHost::whyNot(const std::string& path, const std::string& command) const {
    const auto frame = commands_.session().frame();
    const explorer::Order order{path, command};
    return whyNotNowOf(*frame, findOrder(*frame, order), order);
}

// Without control nothing is sent, but the window offers to take it.
void ViewHost::send(QWidget& asker, const explorer::Order& order, Done done) {
    const auto frame = commands_.session().frame();
    const Found found = findOrder(*frame, order);
    const QString why = whyNotNowOf(*frame, found, order);
    if (!why.isEmpty()) {
        if (done) done({false, why, {}});
        if (found.why.isEmpty()) offerControl(*frame, *found.place, found.available);
    } else if (found.command != nullptr && found.command->confirm) {
        ask(asker, order, *found.command, std::move(done));
    } else {
        sendNow(asker, order, found.command, std::move(done));
    }
}

// At the button that has the keyboard, if it is of the view that asks.
void ViewHost::ask(QWidget& asker, const explorer::Order& order, const Command& command,
                   Done done) {
    const QWidget* focused = QApplication::focusWidget();
    const bool isOfIt = focused != nullptr && asker.isAncestorOf(focused);
    const auto whyNot = [this, order] {
        const auto frame = commands_.session().frame();
        return whyNotNowOf(*frame, findOrder(*frame, order), order);
    };
    const auto yes = [this, &asker, order, command, done = std::move(done)] {
        sendNow(asker, order, &command, done);
    };
    const auto owner = [this, path = order.path] {
        const auto frame = commands_.session().frame();
        const auto place = frame->find(path);
        return place ? startOf(frame->agents[place->agent]) : AgentStart{};
    };
    askToRun(asker, isOfIt ? *focused : asker,
             {order.path, command, order.arguments, owner, whyNot, yes});
}

// Only where nothing else stands in the way.
void ViewHost::offerControl(const Frame& frame, Place place, StateSet available) {
    const AgentFrame& agent = frame.agents[place.agent];
    if (agent.lost() || frame.control.covers(agent.status.name, frame.info(place).path)) return;
    const auto state = agent.state(place.simplex);
    if (available != StateSet::always() && !(state && available.has(*state))) return;
    Q_EMIT controlWanted(scopeOf(frame, place));
}

void ViewHost::sendNow(QWidget& asker, const explorer::Order& order, const Command* command,
                       Done done) {
    const bool isLong = command != nullptr && command->isLong;
    const auto limit =
        isLong ? untilItEnds : std::max<std::chrono::milliseconds>(order.budget + 1s, 5s);
    const auto known = command != nullptr ? std::optional{*command} : std::nullopt;
    commands_.send(
        order.path, order.command, order.arguments, limit, &asker,
        [done = std::move(done), known](const CommandOutcome& outcome) {
            if (!done) return;
            done({outcome.problem.empty() && outcome.answer.done(),
                  outcomeText(outcome, known ? &*known : nullptr), outcome.answer.response});
        },
        {}, order.budget);
}

explorer::Hold* ViewHost::hold(QWidget& button, const explorer::HeldOrder& order) {
    auto* held = new HeldButton{commands_.session(), button, order,
                                whyNot(order.order.path, order.order.command)};
    if (held->runs()) held_.emplace_back(held);
    return held;
}

// That of the simplex's table of data; a page of its own has none, and shows units as in the model.
explorer::ShownUnit ViewHost::shownUnit(const QWidget& asker, const std::string& unit) const {
    const auto* page = pageOf(asker);
    DataItem item;
    item.kind = Kind::Float;
    item.unit = unit;
    const auto shown = page != nullptr ? page->units().of(item) : nullptr;
    return shown ? explorer::ShownUnit{unitText(shown->item.unit), shown->factor}
                 : explorer::ShownUnit{unitText(unit)};
}

void ViewHost::chooseUnit(QWidget& asker, const std::string& unit) {
    auto* page = pageOf(asker);
    if (page == nullptr) return;
    ShownUnits chosen = page->units();
    for (std::size_t i = 0; i < ShownUnits::quantities; ++i) {
        if (std::ranges::count(unitQuantities()[i].units, unit) > 0) chosen.choose(i, unit);
    }
    page->setUnits(chosen);
}

void ViewHost::refresh() {
    for (const HoldEnd& end : commands_.session().takeHoldEnds()) {
        for (const QPointer<HeldButton>& each : held_) {
            if (each && each->number() == end.number) each->finish(QString::fromStdString(end.why));
        }
    }
    std::erase_if(held_, [](const QPointer<HeldButton>& each) { return !each || !each->runs(); });
}

}  // namespace cortex::gui
