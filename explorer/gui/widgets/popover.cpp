// SPDX-License-Identifier: Apache-2.0
#include "widgets/popover.hpp"

#include "style/look.hpp"
#include "widgets/enter_key.hpp"
#include "widgets/text_label.hpp"

#include <QCloseEvent>
#include <QGuiApplication>
#include <QPainter>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>

namespace cortex::gui {

namespace {

// As large as its content, as far as it may be.
class ScrolledRows : public QScrollArea {
public:
    explicit ScrolledRows(QWidget* content) {
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);
        setWidgetResizable(true);
        setWidget(content);
        content->setAutoFillBackground(false);
        viewport()->setAutoFillBackground(false);
        QSizePolicy policy{QSizePolicy::Preferred, QSizePolicy::Preferred};
        policy.setHeightForWidth(true);
        setSizePolicy(policy);
    }
    QSize sizeHint() const override { return widget()->sizeHint(); }
    int heightForWidth(int width) const override {
        const QLayout& rows = *widget()->layout();
        return rows.hasHeightForWidth() ? rows.totalHeightForWidth(width) : sizeHint().height();
    }

protected:
    // What is around it hears that the content has another size.
    bool viewportEvent(QEvent* event) override {
        if (event->type() == QEvent::LayoutRequest) updateGeometry();
        return QScrollArea::viewportEvent(event);
    }
};

}  // namespace

Popover::Popover(const QString& title, QWidget* parent)
    : QFrame{parent, Qt::Popup | Qt::FramelessWindowHint},
      title_{new TextLabel{TextSize::Value, true}},
      rows_{new QVBoxLayout},
      buttons_{new QHBoxLayout} {
    setAttribute(Qt::WA_DeleteOnClose);
    auto* all = new QVBoxLayout{this};
    all->setContentsMargins(Look::units(5), Look::units(4), Look::units(5), Look::units(4));
    all->setSizeConstraint(QLayout::SetNoConstraint);
    title_->show(title);
    all->addWidget(title_);
    auto* content = new QWidget;
    content->setLayout(rows_);
    rows_->setContentsMargins(0, 0, 0, 0);
    all->addWidget(new ScrolledRows{content}, 1);
    all->addLayout(buttons_);
    buttons_->addStretch(1);
    setAccessibleName(title);
}

void Popover::lieOnScreenOf(const QWidget& widget) {
    const QScreen* screen = widget.screen();
    if (screen == nullptr) screen = QGuiApplication::primaryScreen();
    screen_ = screen->availableGeometry();
    fit();
}

void Popover::openAmid(const QWidget& window) {
    lieOnScreenOf(window);
    moveInside(window.mapToGlobal(window.rect().center()) - rect().center());
    show();
}

void Popover::openBelow(const QWidget& anchor) {
    const QWidget& window = *anchor.window();
    lieOnScreenOf(anchor);
    const QPoint at = anchor.mapToGlobal({}), edge = window.mapToGlobal({});
    const int right = std::max(edge.x() + window.width() - width(), edge.x());
    const int below = at.y() + anchor.height(), above = at.y() - height();
    const bool up = below + height() > screen_.bottom() + 1 && above >= screen_.top();
    moveInside({std::clamp(at.x(), edge.x(), right), up ? above : below});
    show();
}

// No larger than the screen.
void Popover::fit() {
    const QLayout& all = *layout();
    int width = std::min(all.totalSizeHint().width(), screen_.width());
    int height = all.totalHeightForWidth(width);
    if (height > screen_.height()) {
        const auto* area = findChild<QScrollArea*>();
        width = std::min(width + area->verticalScrollBar()->sizeHint().width(), screen_.width());
        height = screen_.height();
    }
    resize(width, height);
}

void Popover::moveInside(QPoint corner) {
    move(std::clamp(corner.x(), screen_.left(), screen_.right() + 1 - width()),
         std::clamp(corner.y(), screen_.top(), screen_.bottom() + 1 - height()));
}

bool Popover::event(QEvent* event) {
    const bool done = QFrame::event(event);
    if (event->type() == QEvent::LayoutRequest && !screen_.isEmpty()) {
        fit();
        moveInside(pos());
    }
    return done;
}

void Popover::closeEvent(QCloseEvent* event) {
    QFrame::closeEvent(event);
    Q_EMIT closed();
}

void Popover::keyPressEvent(QKeyEvent* event) {
    if (!pressFocused(*event, *this)) QFrame::keyPressEvent(event);
}

void Popover::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter{this};
    painter.fillRect(rect(), Look::colours().raised);
    painter.setPen(QPen{Look::colours().border, static_cast<double>(Look::lineWidth())});
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

}  // namespace cortex::gui
