// SPDX-License-Identifier: Apache-2.0
#include "window/hand_over_panel.hpp"

#include "model/holders.hpp"
#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <set>
#include <tuple>

namespace cortex::gui {

namespace {

// The windows and shells that are there, by person; then all others who hold something, by name.
QStringList takersIn(const Frame& frame) {
    auto tools = frame.control.tools;
    std::ranges::sort(
        tools, {}, [](const comms::ToolStatus& each) { return std::tie(each.person, each.name); });
    QStringList names;
    for (const comms::ToolStatus& each : tools) names << QString::fromStdString(each.name);
    std::set<std::string> holders;
    for (const AgentFrame& agent : frame.agents) {
        for (const comms::ShownLease& each : leasesOf(agent)) holders.insert(each.holder);
    }
    holders.erase(frame.control.self);
    for (const std::string& each : holders) {
        if (const auto name = QString::fromStdString(each); !names.contains(name)) names << name;
    }
    return names;
}

constexpr int nameRole = Qt::UserRole, wholeRole = Qt::UserRole + 1;
constexpr int rowsInSight = 5, linesOfWhat = 2;

QLabel* line(const QString& text) {
    auto* label = new QLabel{text};
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    QSizePolicy kept = label->sizePolicy();
    kept.setRetainSizeWhenHidden(true);  // the place is as high with names instead
    label->setSizePolicy(kept);
    return label;
}

QString whatText(const Control& control) {
    QStringList scopes;
    for (const std::string& each : control.prefixes()) scopes << scopeText(each);
    if (scopes.isEmpty()) return HandOverPanel::tr("You hold nothing any longer.");
    if (scopes.size() == 1)
        return HandOverPanel::tr("A click, or Enter twice, hands over %1 to:").arg(scopes.front());
    return HandOverPanel::tr(
               "A click, or Enter twice, hands over everything that you hold, %1, to:")
        .arg(joined(scopes));
}

}  // namespace

HandOverPanel::HandOverPanel(const std::shared_ptr<const Frame>& frame, QWidget* parent)
    : Popover{tr("Hand over control"), parent},
      what_{new TextLabel{TextSize::Text}},
      nobody_{
          line(tr("No other window or shell is there, and nobody else holds anything. Write the "
                  "name of a program below, as it says it."))},
      others_{new QListWidget},
      place_{new QStackedWidget},
      name_{new QLineEdit},
      handOver_{new QPushButton{tr("Hand over")}} {
    what_->setWordWrap(true);
    what_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    what_->setFixedHeight(what_->heightOfLines(linesOfWhat));
    rows().addWidget(what_);
    place_->addWidget(nobody_);
    place_->addWidget(others_);
    rows().addWidget(place_);
    rows().addWidget(line(tr("Another name, with the button:")));
    rows().addWidget(name_);
    rows().addWidget(
        line(tr("They must renew it within 2 s; another window and a shell do so by themselves.")));
    rows().addWidget(line(tr("To others you are %1.").arg(ownName(frame->control))));
    auto* cancel = new QPushButton{tr("Cancel")};
    buttons().addWidget(cancel);
    buttons().addWidget(handOver_);
    others_->setMinimumHeight(Look::units(6) * rowsInSight + Look::units(2));
    others_->setTextElideMode(Qt::ElideMiddle);
    others_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    others_->setAccessibleName(tr("Who can have control"));
    others_->installEventFilter(this);
    others_->viewport()->setCursor(Qt::PointingHandCursor);
    name_->setAccessibleName(tr("Name of an agent or tool"));
    name_->setPlaceholderText(tr("cortex@host.1234-5e1f0a"));
    name_->setMinimumWidth(Look::units(110));
    connect(cancel, &QPushButton::clicked, this, &QWidget::close);
    connect(others_, &QListWidget::itemClicked, this,
            [this](const QListWidgetItem* row) { give(row->data(nameRole).toString()); });
    connect(name_, &QLineEdit::textChanged, this, &HandOverPanel::decide);
    connect(name_, &QLineEdit::returnPressed, handOver_, &QPushButton::click);
    connect(handOver_, &QPushButton::clicked, this, [this] { give(name_->text().trimmed()); });
    refresh(frame);
}

void HandOverPanel::decide() {
    handOver_->setEnabled(holds_ && !name_->text().trimmed().isEmpty());
}

void HandOverPanel::give(const QString& name) {
    if (given_ || !holds_ || name.isEmpty()) return;
    given_ = true;
    Q_EMIT chosen(name.toStdString());
    close();
}

void HandOverPanel::focusFirst() {
    const bool any = others_->count() > 0;
    (any ? static_cast<QWidget*>(others_) : name_)->setFocus(Qt::TabFocusReason);
}

// A row is chosen, by an arrow or Enter, before Enter hands over: nobody gets it by the key that
// opened this.
bool HandOverPanel::eventFilter(QObject* object, QEvent* event) {
    if (object != others_ || event->type() != QEvent::KeyPress)
        return Popover::eventFilter(object, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    const auto chosen = others_->selectedItems();
    const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
    if (enter && key->isAutoRepeat()) return true;
    if (enter && !chosen.isEmpty()) {
        give(chosen.front()->data(nameRole).toString());
        return true;
    }
    const bool arrow = key->key() == Qt::Key_Down || key->key() == Qt::Key_Up;
    if (!(arrow || enter) || !chosen.isEmpty()) return Popover::eventFilter(object, event);
    for (int i = 0; i < others_->count(); ++i) {
        if (!others_->item(i)->flags().testFlag(Qt::ItemIsEnabled)) continue;
        others_->setCurrentRow(i);
        break;
    }
    return true;
}

QStringList HandOverPanel::offered() const {
    QStringList names;
    for (int i = 0; i < others_->count(); ++i) names << others_->item(i)->data(nameRole).toString();
    return names;
}

QString HandOverPanel::whyNobody() const {
    return place_->currentWidget() == nobody_ ? nobody_->text() : QString{};
}

void HandOverPanel::add(const QStringList& names) {
    const QStringList before = offered();
    for (const QString& name : names) {
        if (before.contains(name)) continue;
        auto* row = new QListWidgetItem{others_};
        row->setData(nameRole, name);
    }
}

// Who is gone keeps the name that was shown.
void HandOverPanel::showRow(QListWidgetItem& row, const Frame& frame, bool isThere) {
    const QString name = row.data(nameRole).toString();
    const std::string holder = name.toStdString();
    if (isThere) row.setData(wholeRole, wholeNameOf(frame.control, holder));
    const QString whole = row.data(wholeRole).toString();
    const bool usesOne = whole != wholeNameOf({}, holder);
    const QString text = isThere   ? whole
                         : usesOne ? tr("%1 – gone").arg(whole)
                                   : tr("%1 – holds nothing now").arg(whole);
    const Qt::ItemFlags flags =
        isThere ? Qt::ItemIsEnabled | Qt::ItemIsSelectable : Qt::ItemFlags{Qt::NoItemFlags};
    if (row.text() == text && row.flags() == flags) return;
    if (!isThere) row.setSelected(false);
    row.setFlags(flags);
    row.setText(text);
    row.setToolTip(tipText(text));
}

// What was chosen stays chosen.
void HandOverPanel::refresh(const std::shared_ptr<const Frame>& frame) {
    const QStringList takers = takersIn(*frame);
    add(takers);
    for (int i = 0; i < others_->count(); ++i) {
        QListWidgetItem& row = *others_->item(i);
        showRow(row, *frame, takers.contains(row.data(nameRole).toString()));
    }
    if (others_->count() > 0) place_->setCurrentWidget(others_);
    what_->show(whatText(frame->control));
    what_->setToolTip(tipText(what_->text()));
    holds_ = !frame->control.prefixes().empty();
    decide();
}

}  // namespace cortex::gui
