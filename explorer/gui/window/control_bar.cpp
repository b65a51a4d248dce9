// SPDX-License-Identifier: Apache-2.0
#include "window/control_bar.hpp"

#include "model/permission.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>

namespace cortex::explorer {

namespace {

// What was refused or lost, on the background of a warning.
class NoticeRow : public QWidget {
protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter{this}.fillRect(rect(), Look::colours().warnBg);
    }
};

}  // namespace

ControlBar::ControlBar(Session& session, QWidget* parent)
    : QWidget{parent},
      session_{session},
      frame_{session.frame()},
      label_{new TextLabel{TextSize::Text}},
      handOver_{new QPushButton{tr("Hand over…")}},
      button_{new QPushButton},
      notice_{new NoticeRow},
      noticeText_{new TextLabel{TextSize::Text, true, &Tokens::warnText}},
      again_{new QPushButton} {
    auto* row = new QHBoxLayout{this};
    row->setContentsMargins(Look::units(2), 0, 0, 0);
    row->setSpacing(Look::units(4));
    row->addWidget(label_);
    row->addWidget(handOver_);
    row->addWidget(button_);
    handOver_->hide();
    label_->keepWhole();
    label_->show(text());
    button_->setText(tr("Take control…"));
    button_->setToolTip(tr("Ctrl+T; releasing is Ctrl+Shift+T"));
    connect(button_, &QPushButton::clicked, this, [this] { holds() ? release() : choose(); });
    connect(handOver_, &QPushButton::clicked, this, &ControlBar::chooseHandOver);
    connect(again_, &QPushButton::clicked, this, &ControlBar::takeAgain);
    makeNotice();
}

void ControlBar::makeNotice() {
    auto* row = new QHBoxLayout{notice_};
    row->setContentsMargins(Look::units(4), Look::units(1), Look::units(2), Look::units(1));
    noticeText_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    auto* close = new QPushButton{tr("Close")};
    row->addWidget(noticeText_);
    row->addWidget(again_);
    row->addWidget(close);
    notice_->hide();
    connect(close, &QPushButton::clicked, this, [this] {
        told_ = noticeText_->text();
        notice_->hide();
    });
}

QString ControlBar::text() const {
    const Control& control = frame_->control;
    if (!control.asks.empty()) return tr("Asking for %1").arg(scopeText(control.asks));
    if (control.prefix.empty()) return tr("Read-only");
    QStringList parts;
    for (const std::string& each : control.prefixes()) parts << scopeText(each);
    if (narrow_) return tr("You control %1").arg(parts.join(tr(" and ")));
    return tr("You control %1 since %2").arg(parts.join(tr(" and ")), clockText(control.since));
}

QString ControlBar::noticeText() const {
    return notice_->isHidden() ? QString{} : noticeText_->text();
}

void ControlBar::refresh(const std::shared_ptr<const Frame>& frame, const std::string& path) {
    frame_ = frame;
    path_ = path;
    const Control& control = frame->control;
    label_->show(text(), control.prefix.empty() ? &Tokens::ink2 : &Tokens::onAccent);
    if (control.prefix != prefix_) {
        prefix_ = control.prefix;
        button_->setText(holds() ? tr("Release") : tr("Take control…"));
        handOver_->setVisible(holds() && !narrow_);
        update();
        Q_EMIT changed();
    }
    const QString said = QString::fromStdString(control.notice);
    if (said.isEmpty()) told_.clear();
    noticeText_->show(said);
    notice_->setVisible(!said.isEmpty() && said != told_);
    again_->setVisible(!control.last.empty() && !holds() && control.asks.empty());
    again_->setText(tr("Take %1 again").arg(scopeText(control.last)));
    if (panel_) panel_->refresh(frame);
    if (handOverPanel_) handOverPanel_->refresh(frame);
}

// The time and *Hand over…* give way; that stands in the menu, too.
void ControlBar::setNarrow(bool narrow) {
    narrow_ = narrow;
    handOver_->setVisible(holds() && !narrow);
    label_->show(text());
}

void ControlBar::choose() {
    if (panel_) return;
    panel_ = new ControlPanel{frame_, path_, this};
    connect(panel_, &ControlPanel::taken, this, [this](const std::string& prefix) {
        told_.clear();
        session_.takeControl(prefix);
    });
    showBelow(*panel_);
    panel_->focusChosen();
}

void ControlBar::showBelow(QWidget& popover) {
    popover.adjustSize();
    const QPoint corner = mapToGlobal(rect().bottomRight());
    popover.move(corner - QPoint{popover.width(), -Look::units(1)});
    popover.show();
}

void ControlBar::chooseHandOver() {
    if (handOverPanel_ || !holds()) return;
    handOverPanel_ = new HandOverPanel{frame_, this};
    connect(handOverPanel_, &HandOverPanel::chosen, this, [this](const std::string& name) {
        told_.clear();
        session_.handOver(name);
    });
    showBelow(*handOverPanel_);
    handOverPanel_->nameField().setFocus();
}

void ControlBar::takeAgain() {
    told_.clear();
    session_.takeControl(frame_->control.last);
}

void ControlBar::release() { session_.releaseControl(); }

// What the operator holds is blue.
void ControlBar::paintEvent(QPaintEvent* /*event*/) {
    if (!holds()) return;
    QPainter painter{this};
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(Look::colours().accent);
    const int height = Look::units(6);
    const QRect chip{label_->x() - Look::units(2), (this->height() - height) / 2,
                     label_->width() + Look::units(4), height};
    painter.drawRoundedRect(chip, Look::units(1), Look::units(1));
}

}  // namespace cortex::explorer
