// SPDX-License-Identifier: Apache-2.0
#include "views/edit_bar.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "model/value_text.hpp"
#include "widgets/low_buttons.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <algorithm>
#include <iterator>
#include <utility>

namespace cortex::gui {

namespace {

constexpr std::chrono::milliseconds setLimit = std::chrono::seconds{5};
constexpr std::size_t mostUndone = 20;

// The value that the agent has now; none: it did not come.
std::optional<Value> valueNow(const Frame& frame, const std::string& path,
                              const std::string& item) {
    const auto place = frame.find(path);
    if (!place) return std::nullopt;
    const AgentFrame& agent = frame.agents[place->agent];
    const ItemLayout* layout = frame.info(*place).layout->find(item);
    if (layout == nullptr || !agent.came(place->simplex)) return std::nullopt;
    return (*agent.image)->value(place->simplex, *layout);
}

bool shows(const Frame& frame, const std::string& path, const comms::Mirror::Arguments& items) {
    return std::ranges::all_of(
        items, [&](const auto& each) { return valueNow(frame, path, each.first) == each.second; });
}

QString failureText(const CommandOutcome& outcome) {
    const bool sent = outcome.problem.empty() && outcome.answer.outcome != Outcome::Unknown;
    const QString why = outcomeText(outcome);
    return sent ? EditBar::tr("Not set: %1").arg(why) : why;
}

}  // namespace

EditBar::EditBar(Commands& commands, ItemModel& items, QWidget* parent)
    : QWidget{parent},
      commands_{commands},
      items_{items},
      told_{new TextLabel{TextSize::Text}},
      set_{new QPushButton},
      discard_{new QPushButton{tr("Discard")}},
      undo_{new QPushButton{tr("Undo")}} {
    auto* row = new QHBoxLayout{this};
    row->addWidget(told_, 1);
    told_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    for (QPushButton* each : {undo_, discard_, set_}) row->addWidget(each);
    // Undo never stands where Set was just pressed.
    for (QPushButton* each : {discard_, set_}) {
        QSizePolicy policy = each->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        each->setSizePolicy(policy);
    }
    set_->setText(tr("Set %n items", nullptr, 2));
    connect(set_, &QPushButton::clicked, this, &EditBar::submit);
    connect(discard_, &QPushButton::clicked, this, &EditBar::discard);
    connect(undo_, &QPushButton::clicked, this, &EditBar::undo);
    for (QPushButton* each : {undo_, discard_, set_})
        connect(each, &QPushButton::clicked, this, &EditBar::pressed);
    connect(&items_, &ItemModel::refused, this, [this](const QString& why) {
        say(why, &Tokens::warnText);
        saysWhyNot_ = false;
        refused_ = true;
    });
    connect(&items_, &ItemModel::accepted, this, &EditBar::forgetRefusal);
    connect(&items_, &ItemModel::setAside, this, &EditBar::sayAside);
    setLow(false);
    hide();
}

void EditBar::setLow(bool low) {
    const int side = Look::units(4), above = low ? 0 : Look::units(1);
    layout()->setContentsMargins(side, above, side, above);
    lowerWhereLow({undo_, discard_, set_});
}

void EditBar::show(const std::string& path) {
    if (path == path_) return;
    path_ = path;
    frame_ = nullptr;
    sayLast();
}

// What became of the last set here, also of one that another view has sent.
void EditBar::sayLast() {
    saysWhyNot_ = false;
    if (const auto found = outcomes_.find(path_); found != outcomes_.end()) {
        refused_ = found->second.colour == &Tokens::warnText;
        say(found->second.text, found->second.colour);
        return;
    }
    const Commands::Last* last = commands_.last(path_, "set");
    const bool failed = last != nullptr && last->outcome && !last->outcome->answer.done();
    refused_ = failed;
    told_->show({});
    if (failed) say(failureText(*last->outcome), &Tokens::warnText);
}

void EditBar::forgetRefusal() {
    if (!std::exchange(refused_, false) || sending_.contains(path_)) return;
    outcomes_.erase(path_);
    told_->show({});
}

void EditBar::refresh(const std::shared_ptr<const Frame>& frame, Place place) {
    frame_ = frame;
    place_ = place;
    finishWhatShows();
    forgetWhatChanged();
    const int count = static_cast<int>(items_.edits().size());
    if (count > 0) sayPending();
    if (count > 0) set_->setText(tr("Set %n items", nullptr, count));
    set_->setVisible(count > 0);
    discard_->setVisible(count > 0);
    discard_->setEnabled(!sending_.contains(path_));
    const auto last = lastDone();
    if (last != done_.end() && shows(*frame_, path_, last->after)) last->came = true;
    undo_->setVisible(last != done_.end() && count == 0);
    if (last != done_.end()) undo_->setToolTip(tipText(tr("%1\nCtrl+Z").arg(textOf(*last))));
    setVisible(count > 0 || !told_->text().isEmpty());
}

// What became of those that were sent stays, until a person enters or sends something.
void EditBar::sayPending() {
    const QString why = whyNot(items_.edits());
    set_->setEnabled(why.isEmpty());
    set_->setToolTip(why.isEmpty() ? tr("Enter in a field") : tipText(why));
    if (refused_ || sending_.contains(path_)) return;
    if (why.isEmpty() && !told_->text().isEmpty() && !saysWhyNot_) return;
    saysWhyNot_ = true;
    say(why.isEmpty() ? tr("Not sent yet.") : tr("Not sent: %1").arg(why), &Tokens::ink);
}

// What was not answered has been executed once its values are there.
void EditBar::finishWhatShows() {
    const auto found = unanswered_.find(path_);
    if (found == unanswered_.end() || frame_->agents[place_.agent].lost()) return;
    if (!shows(*frame_, path_, found->second.change.after)) return;
    const Sent sent = std::move(found->second);
    unanswered_.erase(found);
    if (sent.undoes)
        std::erase_if(done_, [&](const Done& each) {
            return each.path == path_ && each.after == sent.change.before;
        });
    finish(sent);
}

// "Set: …" goes once somebody has set another value.
void EditBar::forgetWhatChanged() {
    const auto said = outcomes_.find(path_);
    if (said == outcomes_.end() || said->second.holds.empty()) return;
    const bool holds = shows(*frame_, path_, said->second.holds);
    if (holds) said->second.held = true;
    if (holds || !said->second.held) return;
    outcomes_.erase(said);
    told_->show({});
}

QString EditBar::whyNot(const comms::Mirror::Arguments& items) const {
    if (sending_.contains(path_)) return tr("the last set is not answered yet");
    for (const auto& [name, value] : items) {
        const DataItem* item = frame_->type(place_).findData(name);
        if (item == nullptr) return tr("%1 is gone").arg(QString::fromStdString(name));
        const QString why = whyNotNow(*frame_, place_, item->settable);
        if (!why.isEmpty()) return why;
    }
    return {};
}

int EditBar::unsent() const { return static_cast<int>(items_.edits().size()); }

void EditBar::submit() { sendEdits(items_.edits()); }

void EditBar::submitFresh() { sendEdits(items_.freshEdits()); }

void EditBar::sendEdits(const ItemEdits::Values& edits) {
    if (frame_ == nullptr || edits.empty() || !whyNot(edits).isEmpty()) return;
    Done change{path_, {}, {}, startOf(frame_->agents[place_.agent])};
    for (const auto& [name, value] : edits) {
        const auto before = valueNow(*frame_, path_, name);
        if (before) change.before[name] = *before;
        change.after[name] = value;
    }
    send({std::move(change), false, ItemEdits::count()});
}

void EditBar::discard() {
    items_.clearEdits();
    unanswered_.erase(path_);
    refused_ = false;
    outcomes_.erase(path_);
    told_->show({});
}

EditBar::Changes::iterator EditBar::lastDone() {
    const auto found = std::ranges::find_if(
        done_.rbegin(), done_.rend(), [this](const Done& each) { return each.path == path_; });
    return found == done_.rend() ? done_.end() : std::prev(found.base());
}

void EditBar::undo() {
    const auto found = lastDone();
    if (found == done_.end() || frame_ == nullptr) return;
    if (const QString why = whyNotUndone(*found); !why.isEmpty()) {
        tell(path_, why, &Tokens::warnText);
        done_.erase(found);
        return;
    }
    if (const QString why = whyNot(found->after); !why.isEmpty()) {
        say(tr("Not undone: %1").arg(why), &Tokens::warnText);
        return;
    }
    Done change = std::move(*found);
    done_.erase(found);
    std::swap(change.before, change.after);
    send({std::move(change), true});
}

// What it never can be.
QString EditBar::whyNotUndone(const Done& change) const {
    const AgentStart now = startOf(frame_->agents[place_.agent]);
    if (now.agent != change.start.agent)
        return tr("Not undone: %1 has %2 since.").arg(plainText(now.agent), plainText(change.path));
    if (now != change.start) return tr("Not undone: the agent has started anew since.");
    for (const auto& [name, value] : change.after) {
        const bool isAsSet = !change.came || valueNow(*frame_, path_, name) == value;
        if (isAsSet && !isSetByOthers(change, name)) continue;
        return tr("Not undone: somebody else has set %1 since.").arg(plainText(name));
    }
    return {};
}

void EditBar::sayAside(const std::string& path, const QStringList& items) {
    const char* text = items.size() == 1 ? QT_TR_NOOP("Not kept: %1, as its type has changed")
                                         : QT_TR_NOOP("Not kept: %1, as their types have changed");
    tell(path, tr(text).arg(items.join(tr(", "))), &Tokens::warnText);
}

bool EditBar::isSetByOthers(const Done& change, const std::string& item) const {
    const auto known = change.byOthers.find(item);
    return known != change.byOthers.end() &&
           commands_.setByOthers(change.path, item) != known->second;
}

void EditBar::send(Sent sent) {
    const std::string path = sent.change.path;
    sending_.insert(path);
    unanswered_.erase(path);
    tell(path, tr("Sending…"), &Tokens::ink);
    auto arguments = sent.change.after;
    commands_.send(
        path, "set", std::move(arguments), setLimit, this,
        [this, sent = std::move(sent)](const CommandOutcome& outcome) { answered(sent, outcome); });
}

void EditBar::answered(const Sent& sent, const CommandOutcome& outcome) {
    const Done& change = sent.change;
    sending_.erase(change.path);
    if (outcome.answer.done()) return finish(sent);
    tell(change.path, failureText(outcome), &Tokens::warnText);
    if (outcome.answer.outcome == Outcome::Unknown) unanswered_[change.path] = sent;
    if (sent.undoes)
        done_.push_back({change.path, change.after, change.before, change.start, change.byOthers});
}

void EditBar::finish(const Sent& sent) {
    Done change = sent.change;
    for (const auto& [name, value] : change.after)
        change.byOthers[name] = commands_.setByOthers(change.path, name);
    QString text = (sent.undoes ? tr("Undone: %1") : tr("Set: %1")).arg(textOf(change));
    if (!sent.undoes) {
        items_.clearEdits(change.path, change.after, sent.entries);
        if (change.before.size() == change.after.size()) done_.push_back(change);
        if (done_.size() > mostUndone) done_.erase(done_.begin());
    }
    QStringList rest;  // that was entered meanwhile
    if (change.path == path_) {
        for (const auto& [name, value] : items_.edits()) rest << QString::fromStdString(name);
    }
    if (!rest.isEmpty()) text += tr(". Not sent yet: %1").arg(rest.join(tr(", ")));
    tell(change.path, text, &Tokens::ink);
    outcomes_[change.path].holds = change.after;
}

// As the table shows it; where that is not the unit of the model, with its unit.
QString EditBar::textOf(const std::string& path, const std::string& item,
                        const Value& value) const {
    const auto place = frame_ ? frame_->find(path) : std::nullopt;
    const DataItem* known = place ? frame_->type(*place).findData(item) : nullptr;
    const auto shown = known != nullptr ? items_.units().of(*known) : nullptr;
    if (!shown) return isolatedText(toText(value));
    return shownEntry(shown.get(), *known, value) + ' ' + unitText(shown->item.unit);
}

QString EditBar::textOf(const Done& change) const {
    QStringList parts;
    for (const auto& [name, value] : change.after) {
        const auto before = change.before.find(name);
        const QString was = before != change.before.end()
                                ? textOf(change.path, name, before->second)
                                : QStringLiteral("?");
        parts << QStringLiteral("%1 %2 → %3")
                     .arg(plainText(name), was, textOf(change.path, name, value));
    }
    return parts.join(QStringLiteral(", "));
}

void EditBar::tell(const std::string& path, const QString& text, QColor Tokens::* colour) {
    outcomes_[path] = {text, colour};
    if (path != path_) return;
    saysWhyNot_ = false;
    refused_ = colour == &Tokens::warnText;
    say(text, colour);
}

void EditBar::say(const QString& text, QColor Tokens::* colour) {
    told_->show(text, colour);
    QWidget::show();
}

}  // namespace cortex::gui
