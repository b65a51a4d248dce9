// SPDX-License-Identifier: Apache-2.0
#include "gui/audit.hpp"

#include "gui/audit_whole.hpp"
#include "style/look.hpp"
#include "style/tokens.hpp"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QCoreApplication>
#include <QHeaderView>
#include <QImage>
#include <QLabel>
#include <QMap>
#include <QPixmap>
#include <algorithm>
#include <vector>

namespace cortex::test {

namespace {

using gui::Look;

constexpr double leastContrast = 4.5, leastPoints = 9;
// The stems of small letters do not reach the full colour of their text.
constexpr double antialiased = 0.2;

struct Text {
    const QWidget* widget;
    QString text;
    QRect box;  // in the window
    bool cut, told;
};

bool liesIn(const QWidget& inner, const QWidget& outer) { return outer.isAncestorOf(&inner); }

bool isScrolled(const QWidget& widget) {
    for (const QWidget* each = widget.parentWidget(); each != nullptr;
         each = each->parentWidget()) {
        if (qobject_cast<const QAbstractScrollArea*>(each) != nullptr) return true;
    }
    return false;
}

QString plain(QString text) { return text.remove('&'); }

// A notice may lie over what is below it, until it is closed.
bool isBelowANotice(const QWidget& widget, const QWidget& window) {
    const QRect box{widget.mapTo(&window, QPoint{}), widget.size()};
    for (const QWidget* each : window.findChildren<QWidget*>()) {
        if (!each->inherits("cortex::gui::ControlNotice") || !each->isVisible()) continue;
        const QRect notice{each->mapTo(&window, QPoint{}), each->size()};
        if (!each->isAncestorOf(&widget) && notice.intersects(box)) return true;
    }
    return false;
}

// Of buttons and labels; of a label in several lines, its height counts.
std::vector<Text> textsIn(QWidget& window) {
    std::vector<Text> texts;
    for (const QWidget* each : window.findChildren<QWidget*>()) {
        QString text;
        const auto* label = qobject_cast<const QLabel*>(each);
        const auto* button = qobject_cast<const QAbstractButton*>(each);
        if (label != nullptr) text = label->text();
        if (button != nullptr) text = plain(button->text());
        if (text.isEmpty() || !each->isVisible() || each->visibleRegion().isEmpty()) continue;
        if (isBelowANotice(*each, window)) continue;
        const bool lines = label != nullptr && label->wordWrap();
        const bool cut = lines ? each->height() < label->heightForWidth(each->width())
                               : each->width() + 1 < each->fontMetrics().horizontalAdvance(text);
        const QRect box{each->mapTo(&window, QPoint{}), each->size()};
        texts.push_back({each, text, box, cut, !each->toolTip().isEmpty()});
    }
    return texts;
}

// The greatest contrast of any pixel in a box with the colour that most of its pixels have.
double contrastIn(const QImage& image, const QRect& box) {
    QMap<QRgb, int> counts;
    const QRect seen = box & image.rect();
    for (int y = seen.top(); y <= seen.bottom(); ++y) {
        for (int x = seen.left(); x <= seen.right(); ++x) ++counts[image.pixel(x, y)];
    }
    QRgb ground = 0;
    int most = 0;
    for (auto each = counts.begin(); each != counts.end(); ++each) {
        if (each.value() > most) most = each.value(), ground = each.key();
    }
    double greatest = 1;
    for (auto each = counts.begin(); each != counts.end(); ++each) {
        greatest = std::max(greatest, gui::contrast(QColor{each.key()}, QColor{ground}));
    }
    return greatest;
}

void auditTexts(QWidget& window, const QImage& image, QStringList& found) {
    const std::vector<Text> texts = textsIn(window);
    const QRect whole{QPoint{}, window.size()};
    for (const Text& each : texts) {
        const QString said = '"' + each.text + '"';
        if (each.cut && !each.told) found << said + " is cut, and no tooltip has it";
        if (!whole.contains(each.box) && !isScrolled(*each.widget)) found << said + " is outside";
        if (each.widget->font().pointSizeF() < leastPoints) found << said + " is too small";
        const QRect seen = each.widget->visibleRegion().boundingRect().translated(
            each.widget->mapTo(&window, QPoint{}));
        if (seen.height() < each.widget->fontMetrics().height()) continue;  // scrolled away
        const double contrast = contrastIn(image, seen);
        if (contrast < leastContrast - antialiased)
            found << said + QStringLiteral(" has a contrast of %1").arg(contrast, 0, 'f', 1);
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
        for (std::size_t j = i + 1; j < texts.size(); ++j) {
            const Text &a = texts[i], &b = texts[j];
            const bool nested = liesIn(*a.widget, *b.widget) || liesIn(*b.widget, *a.widget);
            if (nested || !a.box.intersects(b.box) ||
                isScrolled(*a.widget) != isScrolled(*b.widget))
                continue;
            found << '"' + a.text + "\" lies over \"" + b.text + '"';
        }
    }
}

// Cells whose text does not fit need it in their tooltip.
void auditCells(const QWidget& window, QStringList& found) {
    for (const auto* view : window.findChildren<QAbstractItemView*>()) {
        if (!view->isVisible() || qobject_cast<const QHeaderView*>(view) != nullptr) continue;
        const int rowStep = std::max(Look::units(6), 1);
        for (int y = rowStep / 2; y < view->viewport()->height(); y += rowStep) {
            const QModelIndex row = view->indexAt({Look::units(10), y});
            if (!row.isValid()) continue;
            for (int column = 0; column < row.model()->columnCount(row.parent()); ++column) {
                const QModelIndex cell = row.sibling(row.row(), column);
                const QString text = cell.data().toString();
                const QRect box = view->visualRect(cell);
                if (text.isEmpty() || box.isEmpty()) continue;
                const int needed = view->fontMetrics().horizontalAdvance(text);
                if (needed > box.width() && cell.data(Qt::ToolTipRole).toString().isEmpty())
                    found << "the cell \"" + text + "\" is cut, and no tooltip has it";
            }
        }
    }
}

}  // namespace

// A frame may have come at the very end of the events before: it is laid out first.
QStringList unreadableIn(QWidget& window) {
    QCoreApplication::sendPostedEvents();
    QStringList found;
    const QImage image = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
    auditTexts(window, image, found);
    auditCells(window, found);
    if (Look::theme() == gui::Theme::Light) found << cutIn(window);  // no theme has other sizes
    found.removeDuplicates();
    return found;
}

std::string unreadableInEverySize(QWidget& window, const std::function<void()>& refresh) {
    struct Size {
        int width, height;
        double scale;
    };
    const QSize before = window.size();
    std::string findings;
    for (const Size& size : {Size{1280, 800, 1}, Size{1024, 768, 1.25}, Size{800, 600, 1.5}}) {
        for (const char* family : {"DejaVu Sans", "Open Sans"}) {
            Look::apply(gui::Theme::Light, size.scale, QLatin1String{family});
            window.resize(size.width, size.height);
            for (int i = 0; i < 3; ++i) {
                refresh();
                QCoreApplication::processEvents();  // what is laid out lays out more
            }
            for (const QString& each : unreadableIn(window)) {
                findings +=
                    std::to_string(size.width) + ", " + family + ": " + each.toStdString() + '\n';
            }
        }
    }
    Look::apply(gui::Theme::Light, 1, QStringLiteral("Open Sans"));
    window.resize(before);
    return findings;
}

}  // namespace cortex::test
