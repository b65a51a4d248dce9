// SPDX-License-Identifier: Apache-2.0
#include "window/hand_over_panel.hpp"

#include "model/permission.hpp"
#include "model/plain_text.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>

namespace cortex::gui {

namespace {

// Everybody but us who holds a lease of any agent.
QStringList holdersIn(const Frame& frame) {
    QStringList names;
    for (const AgentFrame& agent : frame.agents) {
        for (const comms::ShownLease& each : leasesOf(agent)) {
            const QString name = QString::fromStdString(each.holder);
            if (each.holder != frame.control.self && !names.contains(name)) names << name;
        }
    }
    names.sort();
    return names;
}

constexpr int nameRole = Qt::UserRole;
constexpr int rowsInSight = 5;

QLabel* line(const QString& text) {
    auto* label = new QLabel{text};
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    QSizePolicy kept = label->sizePolicy();
    kept.setRetainSizeWhenHidden(true);  // the place is as high with names instead
    label->setSizePolicy(kept);
    return label;
}

}  // namespace

HandOverPanel::HandOverPanel(const std::shared_ptr<const Frame>& frame, QWidget* parent)
    : Popover{tr("Hand over control of %1").arg(scopeText(frame->control.prefix)), parent},
      nobody_{line(
          tr("Nobody else holds anything now, so no name is known here. Let the other one take "
             "control of a part that is free, and its name stands here. Another window "
             "shows its own name below “Take control…”."))},
      others_{new QListWidget},
      place_{new QStackedWidget},
      name_{new QLineEdit},
      handOver_{new QPushButton{tr("Hand over")}} {
    rows().addWidget(line(tr("To whoever holds something now, or to a name as a tool says it:")));
    place_->addWidget(nobody_);
    place_->addWidget(others_);
    rows().addWidget(place_);
    rows().addWidget(name_);
    rows().addWidget(
        line(tr("They must renew it within 2 s; another window and a shell do so by themselves.")));
    auto* cancel = new QPushButton{tr("Cancel")};
    buttons().addWidget(cancel);
    buttons().addWidget(handOver_);
    others_->setMinimumHeight(Look::units(6) * rowsInSight + Look::units(2));
    others_->setTextElideMode(Qt::ElideMiddle);
    others_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    others_->setAccessibleName(tr("Who holds control of something"));
    name_->setAccessibleName(tr("Name of an agent or tool"));
    name_->setPlaceholderText(tr("cortex@host.1234-5e1f0a"));
    name_->setMinimumWidth(Look::units(90));
    connect(cancel, &QPushButton::clicked, this, &QWidget::close);
    connect(others_, &QListWidget::currentItemChanged, this, &HandOverPanel::use);
    connect(others_, &QListWidget::itemClicked, this, &HandOverPanel::use);
    connect(name_, &QLineEdit::textChanged, this, &HandOverPanel::decide);
    connect(name_, &QLineEdit::returnPressed, handOver_, &QPushButton::click);
    connect(handOver_, &QPushButton::clicked, this, [this] {
        Q_EMIT chosen(name_->text().trimmed().toStdString());
        close();
    });
    refresh(frame);
    decide();
}

void HandOverPanel::decide() { handOver_->setEnabled(!name_->text().trimmed().isEmpty()); }

void HandOverPanel::use(const QListWidgetItem* chosen) {
    if (chosen != nullptr) name_->setText(chosen->data(nameRole).toString());
}

QStringList HandOverPanel::offered() const {
    QStringList names;
    for (int i = 0; i < others_->count(); ++i) names << others_->item(i)->data(nameRole).toString();
    return names;
}

QString HandOverPanel::whyNobody() const {
    return place_->currentWidget() == nobody_ ? nobody_->text() : QString{};
}

// What was chosen stays chosen.
void HandOverPanel::refresh(const std::shared_ptr<const Frame>& frame) {
    const QStringList holders = holdersIn(*frame), before = offered();
    for (const QString& name : holders) {
        if (before.contains(name)) continue;
        auto* row = new QListWidgetItem{name, others_};
        row->setData(nameRole, name);
    }
    for (int i = 0; i < others_->count(); ++i) {
        QListWidgetItem& row = *others_->item(i);
        const QString name = row.data(nameRole).toString();
        const QString text = holders.contains(name) ? name : tr("%1 (holds nothing now)").arg(name);
        row.setText(text);
        row.setToolTip(tipText(text));
    }
    if (others_->count() > 0) place_->setCurrentWidget(others_);
}

}  // namespace cortex::gui
