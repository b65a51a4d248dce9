// SPDX-License-Identifier: Apache-2.0
#include "window/hand_over_panel.hpp"

#include "model/permission.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

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

QLabel* line(const QString& text) {
    auto* label = new QLabel{text};
    label->setTextFormat(Qt::PlainText);
    label->setWordWrap(true);
    return label;
}

}  // namespace

HandOverPanel::HandOverPanel(std::shared_ptr<const Frame> frame, QWidget* parent)
    : Popover{tr("Hand over control of %1").arg(scopeText(frame->control.prefix)), parent},
      nobody_{line(
          tr("Nobody else holds anything now, so no name is known here. Let the other one take "
             "control of a part that is free, and its name stands here. Another window "
             "shows its own name below “Take control…”."))},
      others_{new QListWidget},
      name_{new QLineEdit},
      handOver_{new QPushButton{tr("Hand over")}} {
    rows().addWidget(line(tr("To whoever holds something now, or to a name as a tool says it:")));
    rows().addWidget(nobody_);
    rows().addWidget(others_);
    rows().addWidget(name_);
    rows().addWidget(
        line(tr("They must renew it within 2 s; another window and a shell do so by themselves.")));
    auto* cancel = new QPushButton{tr("Cancel")};
    buttons().addWidget(cancel);
    buttons().addWidget(handOver_);
    others_->setAccessibleName(tr("Who holds control of something"));
    name_->setAccessibleName(tr("Name of an agent or tool"));
    name_->setPlaceholderText(tr("cortex@host.1234-5e1f0a"));
    name_->setMinimumWidth(Look::units(90));
    connect(cancel, &QPushButton::clicked, this, &QWidget::close);
    connect(others_, &QListWidget::currentTextChanged, name_, &QLineEdit::setText);
    connect(name_, &QLineEdit::textChanged, this, &HandOverPanel::decide);
    connect(name_, &QLineEdit::returnPressed, handOver_, &QPushButton::click);
    connect(handOver_, &QPushButton::clicked, this, [this] {
        Q_EMIT chosen(name_->text().trimmed().toStdString());
        close();
    });
    refresh(std::move(frame));
    decide();
}

void HandOverPanel::decide() { handOver_->setEnabled(!name_->text().trimmed().isEmpty()); }

QStringList HandOverPanel::offered() const {
    QStringList names;
    for (int i = 0; i < others_->count(); ++i) names << others_->item(i)->text();
    return names;
}

QString HandOverPanel::whyNobody() const {
    return nobody_->isHidden() ? QString{} : nobody_->text();
}

// What was chosen stays chosen.
void HandOverPanel::refresh(std::shared_ptr<const Frame> frame) {
    frame_ = std::move(frame);
    const QStringList names = holdersIn(*frame_);
    if (shown_ && names == offered()) return;
    shown_ = true;
    const QString typed = name_->text();
    const QSignalBlocker silent{others_};
    others_->clear();
    others_->addItems(names);
    others_->setVisible(!names.isEmpty());
    nobody_->setVisible(names.isEmpty());
    others_->setMaximumHeight(Look::units(6) * std::min<int>(others_->count(), 6) + Look::units(2));
    name_->setText(typed);
}

}  // namespace cortex::gui
