// SPDX-License-Identifier: Apache-2.0
#include "window/control_notice.hpp"

#include "model/plain_text.hpp"
#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QEvent>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <utility>
#include <vector>

namespace cortex::gui {

namespace {

constexpr int momentOfMouse = 500;  // ms, in which nobody has seen it yet
constexpr int momentOfPress =
    1500;  // ms, in which a hand may still be on its way to another button

}  // namespace

ControlNotice::ControlNotice(QWidget* parent)
    : QWidget{parent},
      place_{new QWidget},
      told_{new TextLabel{TextSize::Note, true}},
      text_{new TextLabel{TextSize::Note, true, &Tokens::warnText}},
      again_{new QPushButton},
      remedy_{new QPushButton},
      refuse_{new QPushButton},
      close_{new QPushButton{tr("Close")}} {
    for (QWidget* each :
         std::initializer_list<QWidget*>{told_, again_, text_, remedy_, refuse_, close_}) {
        each->setParent(this);
        each->hide();
    }
    for (TextLabel* each : {told_, text_}) {
        each->setWordWrap(true);
        each->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    }
    for (QPushButton* each : {again_, remedy_, refuse_, close_}) each->setFocusPolicy(Qt::TabFocus);
    connect(close_, &QPushButton::clicked, this, &ControlNotice::dismiss);
    fresh_.setSingleShot(true);
    connect(&fresh_, &QTimer::timeout, this,
            [this] { setAttribute(Qt::WA_TransparentForMouseEvents, false); });
    place_->installEventFilter(this);
    QWidget::hide();
    fit();
}

void ControlNotice::lieIn(QWidget& window, std::vector<QWidget*> left) {
    setParent(&window);
    left_ = std::move(left);
}

bool ControlNotice::isEmpty() const { return told_->text().isEmpty() && text_->text().isEmpty(); }

void ControlNotice::dismiss() {
    const bool told = !told_->text().isEmpty();
    if (told) read_ = told_->text();
    tell(read_);
    Q_EMIT closed();
    if (told) Q_EMIT outcomeClosed();
}

void ControlNotice::tell(const QString& outcome, const QString& again) {
    const QString unread = outcome == read_ ? QString{} : outcome;
    const QString offer = unread.isEmpty() ? QString{} : again;
    if (unread == told_->text() && offer == again_->text()) return;
    if (!unread.isEmpty()) read_.clear();
    told_->show(unread);
    told_->setVisible(!unread.isEmpty());
    again_->setText(offer);
    again_->setVisible(!offer.isEmpty());
    appear();
}

void ControlNotice::show(const QString& text, const QString& remedy, const QString& refusal) {
    if (text == text_->text() && remedy == offered_ && refusal == refuse_->text()) return;
    text_->show(text);
    offered_ = remedy;
    remedy_->setText(remedy);
    refuse_->setText(refusal);
    text_->setVisible(!text.isEmpty());
    remedy_->setVisible(!text.isEmpty() && !remedy.isEmpty());
    refuse_->setVisible(!text.isEmpty() && !refusal.isEmpty());
    appear();
}

QString ControlNotice::text() const { return text_->text(); }

int ControlNotice::keptHeight() const { return std::max(Look::units(7), text_->heightOfLines(2)); }

std::vector<ControlNotice::Shown> ControlNotice::buttons() const {
    std::vector<Shown> all;
    for (QPushButton* each : {again_, remedy_, refuse_, close_})
        if (!each->isHidden()) all.emplace_back(each, each->text(), each->geometry());
    return all;
}

// No button takes the place of another one under a finger.
void ControlNotice::appear() {
    close_->setVisible(!isEmpty() && refuse_->isHidden());
    setVisible(!isEmpty());
    fit();
    update();
    auto now = buttons();
    if (now == seen_) return;
    if (!seen_.empty()) pressable_.start();
    const bool replaces = pressable_.isValid() && !pressable_.hasExpired(momentOfPress);
    seen_ = std::move(now);
    setAttribute(Qt::WA_TransparentForMouseEvents);
    fresh_.start(replaces ? momentOfPress : momentOfMouse);
}

// Over the place that is kept free; in a low window none is.
void ControlNotice::fit() {
    const int kept = keptHeight();
    const bool low = Look::isLow(*place_);
    place_->setFixedHeight(low ? 0 : kept);
    if (isEmpty() || parentWidget() == nullptr) return;
    const QPoint top = place_->mapTo(place_->window(), QPoint{});
    int left = 0;
    for (const QWidget* each : left_)
        if (low && each->isVisible())
            left = std::max(left, each->mapTo(each->window(), QPoint{each->width(), 0}).x());
    const int width = place_->width() - left;
    setGeometry(left, top.y(), width, placeTexts(width, low));
    raise();
}

// From the right, in a row that begins at `top`. Returns where they begin.
int ControlNotice::placeButtons(std::initializer_list<QPushButton*> buttons, int right, int top) {
    const int gap = Look::units(2), high = Look::units(6);
    for (QPushButton* each : buttons) {
        if (each->isHidden()) continue;
        const int wide = each->sizeHint().width();
        each->setGeometry(right - wide, top + (keptHeight() - high) / 2, wide, high);
        right -= wide + gap;
    }
    return right;
}

// A long path in it is cut in its middle, and whole in the tip.
void ControlNotice::cutRemedy(int most) {
    const QFontMetrics metrics = remedy_->fontMetrics();
    const int border = remedy_->sizeHint().width() - metrics.horizontalAdvance(remedy_->text());
    const QString cut = metrics.elidedText(offered_, Qt::ElideMiddle, most - border);
    remedy_->setText(cut);
    remedy_->setToolTip(cut == offered_ ? QString{} : tipText(offered_));
}

// The form that takes the least height, which is returned.
int ControlNotice::placeTexts(int width, bool low) {
    cutRemedy(width * 2 / 5);
    const bool both = !told_->isHidden() && !text_->isHidden();
    if (!both) return arrange(width, Form::Beside);
    std::vector<std::pair<int, Form>> forms;
    for (const Form each : {Form::Beside, Form::Above, Form::Apart})
        if (!low || each != Form::Beside) forms.emplace_back(arrange(width, each), each);
    return arrange(width, std::ranges::min(forms).second);
}

// The buttons are low, so that the room that is kept is small, and stay where they are whatever is
// said. Beside the other text, what became of the order has what it needs, at most half.
int ControlNotice::arrange(int width, Form form) {
    const int gap = Look::units(2), left = Look::units(4), kept = keptHeight();
    const bool both = !told_->isHidden() && !text_->isHidden(), offers = !again_->isHidden();
    const bool beside = form == Form::Beside, apart = form == Form::Apart && offers;
    placeButtons({close_}, width - gap, 0);
    // Its place is kept: no other button ever stands there.
    const int besideClose = width - 2 * gap - close_->sizeHint().width();
    int right = besideClose;
    if (!apart) right = placeButtons({refuse_, remedy_}, right, 0);
    if (form == Form::Above) right = placeButtons({again_}, right, 0);

    const int again = offers && form != Form::Above ? gap + again_->sizeHint().width() : 0;
    const int needed = QFontMetrics{told_->font()}.horizontalAdvance(told_->text()) + 2;
    const int room = (both && beside ? (right - left) / 2 : right - left) - again;
    const int end = left + std::min(needed, room);
    if (again > 0) placeButtons({again_}, end + again, 0);
    const auto put = [](TextLabel& label, int from, int to) {
        const int wide = std::max(to - from, 1);
        label.setGeometry(from, 0, wide, label.heightForWidth(wide));
        return label.isHidden() ? 0 : label.height();
    };
    const int told = put(*told_, left, end), first = apart ? std::max(told, kept) : told;
    if (apart) right = placeButtons({refuse_, remedy_}, besideClose, first);
    const int text = put(*text_, both && beside ? end + again + gap : left, right);
    const int second = apart ? std::max(text, kept) : text;
    const int all = std::max(kept, beside ? std::max(told, text) : first + second);
    const int top = beside ? 0 : (all - first - second) / 2;
    told_->move(told_->x(), top + ((beside ? all : first) - told) / 2);
    text_->move(text_->x(), beside ? (all - text) / 2 : top + first + (second - text) / 2);
    return all;
}

// Also when its texts get another font.
bool ControlNotice::event(QEvent* event) {
    const bool done = QWidget::event(event);
    if (event->type() == QEvent::LayoutRequest) fit();
    return done;
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
