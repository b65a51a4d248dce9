// SPDX-License-Identifier: Apache-2.0
#include "views/edit_bar.hpp"

#include "model/outcome_text.hpp"
#include "model/permission.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPushButton>
#include <utility>

namespace cortex::explorer {

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
    row->setContentsMargins(Look::units(4), Look::units(1), Look::units(4), Look::units(1));
    row->addWidget(told_, 1);
    told_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    for (QPushButton* each : {undo_, discard_, set_}) row->addWidget(each);
    connect(set_, &QPushButton::clicked, this, &EditBar::submit);
    connect(discard_, &QPushButton::clicked, this, &EditBar::discard);
    connect(undo_, &QPushButton::clicked, this, &EditBar::undo);
    connect(&items_, &ItemModel::refused, this,
            [this](const QString& why) { say(why, &Tokens::warnText); });
    hide();
}

void EditBar::show(const std::string& path) {
    if (path == path_) return;
    path_ = path;
    items_.clearEdits();
    told_->show({});
}

void EditBar::refresh(const std::shared_ptr<const Frame>& frame, Place place) {
    frame_ = frame;
    place_ = place;
    const int count = static_cast<int>(items_.edits().size());
    const QString why = whyNot();
    if (count > 0 && (!why.isEmpty() || told_->text().isEmpty())) {
        say(why.isEmpty() ? tr("Not sent yet.") : tr("Not sent: %1").arg(why), &Tokens::ink);
    }
    set_->setText(tr("Set %n items", nullptr, count));
    set_->setVisible(count > 0);
    set_->setEnabled(why.isEmpty());
    discard_->setVisible(count > 0);
    undo_->setVisible(!done_.empty() && done_.back().path == path_ && count == 0);
    if (!done_.empty()) undo_->setToolTip(textOf(done_.back()).toHtmlEscaped());
    setVisible(count > 0 || !told_->text().isEmpty());
}

QString EditBar::whyNot() const {
    if (isSending_) return tr("sending");
    for (const auto& [name, value] : items_.edits()) {
        const DataItem* item = frame_->type(place_).findData(name);
        if (item == nullptr) return tr("%1 is gone").arg(QString::fromStdString(name));
        const QString why = whyNotNow(*frame_, place_, item->settable);
        if (!why.isEmpty()) return why;
    }
    return {};
}

void EditBar::submit() {
    if (items_.edits().empty() || frame_ == nullptr || !whyNot().isEmpty()) return;
    Done change{path_, {}, {}};
    for (const auto& [name, value] : items_.edits()) {
        const auto before = valueNow(*frame_, path_, name);
        if (before) change.before[name] = *before;
        change.after[name] = value;
    }
    send(std::move(change), false);
}

void EditBar::discard() {
    items_.clearEdits();
    told_->show({});
}

void EditBar::undo() {
    if (done_.empty() || isSending_ || frame_ == nullptr) return;
    Done change = std::move(done_.back());
    done_.pop_back();
    for (const auto& [name, value] : change.after) {
        if (valueNow(*frame_, change.path, name) == value) continue;
        say(tr("Not undone: somebody else has set %1 since.").arg(QString::fromStdString(name)),
            &Tokens::warnText);
        return;
    }
    std::swap(change.before, change.after);
    send(std::move(change), true);
}

void EditBar::send(Done change, bool undoes) {
    isSending_ = true;
    say(tr("sending"), &Tokens::ink);
    auto arguments = change.after;
    const std::string path = change.path;
    commands_.send(path, "set", std::move(arguments), setLimit, this,
                   [this, change = std::move(change), undoes](const CommandOutcome& outcome) {
                       answered(change, undoes, outcome);
                   });
}

void EditBar::answered(const Done& change, bool undoes, const CommandOutcome& outcome) {
    isSending_ = false;
    if (!outcome.answer.done()) {
        say(tr("Not set: %1").arg(outcomeText(outcome)), &Tokens::warnText);
        return;
    }
    if (!undoes) {
        if (change.path == path_) items_.clearEdits();
        if (change.before.size() == change.after.size()) done_.push_back(change);
        if (done_.size() > mostUndone) done_.erase(done_.begin());
    }
    say((undoes ? tr("Undone: %1") : tr("Set: %1")).arg(textOf(change)), &Tokens::ink);
}

QString EditBar::textOf(const Done& change) {
    QStringList parts;
    for (const auto& [name, value] : change.after) {
        const auto before = change.before.find(name);
        const std::string was = before != change.before.end() ? toText(before->second) : "?";
        parts << QString::fromStdString(name + " " + was + " → " + toText(value));
    }
    return parts.join(QStringLiteral(", "));
}

void EditBar::say(const QString& text, QColor Tokens::* colour) {
    told_->show(text, colour);
    QWidget::show();
}

}  // namespace cortex::explorer
