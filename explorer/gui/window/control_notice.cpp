// SPDX-License-Identifier: Apache-2.0
#include "window/control_notice.hpp"

#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QEvent>
#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <initializer_list>

namespace cortex::gui {

namespace {

constexpr int momentOfMouse = 500;  // ms, in which nobody has seen it yet

}  // namespace

ControlNotice::ControlNotice(QWidget* parent)
    : QWidget{parent},
      place_{new QWidget},
      row_{new QHBoxLayout{this}},
      told_{new TextLabel{TextSize::Note, true}},
      text_{new TextLabel{TextSize::Note, true, &Tokens::warnText}},
      remedy_{new QPushButton},
      close_{new QPushButton{tr("Close")}} {
    row_->setContentsMargins(Look::units(4), 0, Look::units(2), 0);
    for (QWidget* each : std::initializer_list<QWidget*>{told_, text_, remedy_, close_}) {
        row_->addWidget(each);
        each->hide();
    }
    for (TextLabel* each : {told_, text_}) {
        each->setWordWrap(true);
        const auto across = each == told_ ? QSizePolicy::Fixed : QSizePolicy::Ignored;
        each->setSizePolicy(across, QSizePolicy::Ignored);
    }
    row_->setStretchFactor(text_, 1);
    for (QPushButton* each : {remedy_, close_}) each->setFocusPolicy(Qt::TabFocus);
    connect(close_, &QPushButton::clicked, this, &ControlNotice::close);
    fresh_.setSingleShot(true);
    fresh_.setInterval(momentOfMouse);
    connect(&fresh_, &QTimer::timeout, this,
            [this] { setAttribute(Qt::WA_TransparentForMouseEvents, false); });
    place_->installEventFilter(this);
    QWidget::hide();
    fit();
}

bool ControlNotice::isEmpty() const { return told_->text().isEmpty() && text_->text().isEmpty(); }

void ControlNotice::close() {
    read_ = told_->text();
    tell(read_);
    Q_EMIT closed();
}

void ControlNotice::tell(const QString& outcome) {
    const QString unread = outcome == read_ ? QString{} : outcome;
    if (unread == told_->text()) return;
    if (!unread.isEmpty()) read_.clear();
    told_->show(unread);
    told_->setVisible(!unread.isEmpty());
    appear();
}

void ControlNotice::show(const QString& text, const QString& remedy) {
    if (text == text_->text() && remedy == remedy_->text()) return;
    text_->show(text);
    remedy_->setText(remedy);
    text_->setVisible(!text.isEmpty());
    remedy_->setVisible(!text.isEmpty() && !remedy.isEmpty());
    appear();
}

QString ControlNotice::text() const { return text_->text(); }

void ControlNotice::appear() {
    close_->setVisible(!isEmpty());
    if (isHidden() && !isEmpty()) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        fresh_.start();
    }
    setVisible(!isEmpty());
    fit();
    update();
}

// Over the place that is kept free; in a low window none is.
void ControlNotice::fit() {
    const int kept = std::max(Look::units(7), text_->heightOfLines(2));
    const bool low = Look::isLow(*place_);
    place_->setFixedHeight(low ? 0 : kept);
    if (isEmpty() || parentWidget() == nullptr) return;
    const QPoint top = place_->mapTo(place_->window(), QPoint{});
    const bool beside = low && left_ != nullptr && left_->isVisible();
    const int left = beside ? left_->mapTo(left_->window(), QPoint{left_->width(), 0}).x() : 0;
    const int width = place_->width() - left;
    setGeometry(left, top.y(), width, std::max(kept, placeTexts(width)));
    raise();
    row_->activate();  // a request to lay it out is lost while it is laid out
}

// The buttons are low, so that the room that is kept is small. Where there are both texts, what
// became of the order has what it needs, at most half. Returns the height of the texts.
int ControlNotice::placeTexts(int width) {
    const QMargins margins = row_->contentsMargins();
    int room = width - margins.left() - margins.right();
    for (QPushButton* each : {remedy_, close_}) {
        each->setFixedHeight(Look::units(6));
        if (!each->isHidden()) room -= each->sizeHint().width() + row_->spacing();
    }
    int height = 0;
    if (!told_->isHidden()) {
        const int needed = QFontMetrics{told_->font()}.horizontalAdvance(told_->text()) + 2;
        const int told = std::max(text_->isHidden() ? room : std::min(needed, room / 2), 1);
        told_->setFixedWidth(told);
        room -= told + row_->spacing();
        height = told_->heightForWidth(told);
    }
    if (!text_->isHidden()) height = std::max(height, text_->heightForWidth(std::max(room, 1)));
    return height;
}

bool ControlNotice::eventFilter(QObject* object, QEvent* event) {
    const auto type = event->type();
    if (type == QEvent::Resize || type == QEvent::Move || type == QEvent::StyleChange) fit();
    return QWidget::eventFilter(object, event);
}

void ControlNotice::paintEvent(QPaintEvent* /*event*/) {
    const Tokens& c = Look::colours();
    QPainter painter{this};
    painter.fillRect(rect(), text_->text().isEmpty() ? c.window : c.warnBg);
    if (height() > place_->height())
        painter.fillRect(QRect{0, height() - 1, width(), 1},
                         text_->text().isEmpty() ? c.border : c.warnEdge);
}

}  // namespace cortex::gui
