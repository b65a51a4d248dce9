// SPDX-License-Identifier: Apache-2.0
#include "window/hand_over_panel.hpp"

#include "model/permission.hpp"
#include "session/lease.hpp"
#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>

namespace cortex::explorer {

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
    : QFrame{parent, Qt::Popup},
      others_{new QListWidget},
      name_{new QLineEdit},
      handOver_{new QPushButton{tr("Hand over")}} {
    setAttribute(Qt::WA_DeleteOnClose);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(Look::units(5), Look::units(4), Look::units(5), Look::units(4));
    auto* title = new TextLabel{TextSize::Value, true};
    title->show(tr("Hand over control of %1").arg(scopeText(frame->control.prefix)));
    rows->addWidget(title);
    rows->addWidget(line(tr("To whoever holds something now, or to a name as a tool says it:")));
    rows->addWidget(others_);
    rows->addWidget(name_);
    rows->addWidget(
        line(tr("They must renew it within 2 s; another window and a shell do so by themselves.")));
    auto* last = new QHBoxLayout;
    last->addStretch(1);
    auto* cancel = new QPushButton{tr("Cancel")};
    last->addWidget(cancel);
    last->addWidget(handOver_);
    rows->addLayout(last);
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
    setAccessibleName(title->text());
    refresh(std::move(frame));
    decide();
}

void HandOverPanel::decide() { handOver_->setEnabled(!name_->text().trimmed().isEmpty()); }

QStringList HandOverPanel::offered() const {
    QStringList names;
    for (int i = 0; i < others_->count(); ++i) names << others_->item(i)->text();
    return names;
}

// What was chosen stays chosen.
void HandOverPanel::refresh(std::shared_ptr<const Frame> frame) {
    frame_ = std::move(frame);
    const QStringList names = holdersIn(*frame_);
    if (names == offered() && !others_->isHidden()) return;
    const QString typed = name_->text();
    const QSignalBlocker silent{others_};
    others_->clear();
    others_->addItems(names);
    others_->setVisible(!names.isEmpty());
    others_->setMaximumHeight(Look::units(6) * std::min<int>(others_->count(), 6) + Look::units(2));
    name_->setText(typed);
    adjustSize();
}

void HandOverPanel::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().raised);
    painter.setPen(QPen{Look::colours().border, static_cast<double>(Look::lineWidth())});
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

}  // namespace cortex::explorer
