// SPDX-License-Identifier: Apache-2.0
#include "gui/audit_whole.hpp"

#include "gui/audit_texts.hpp"
#include "model/event_model.hpp"
#include "model/item_model.hpp"
#include "model/value_text.hpp"
#include "widgets/text_label.hpp"

#include <QAbstractButton>
#include <QHeaderView>
#include <QTabBar>
#include <QTreeView>
#include <algorithm>
#include <array>

namespace cortex::test {

namespace {

using gui::EventModel;
using gui::ItemModel;

// Of these, every text: the lease, what was refused or lost, what became of a stop, why a command
// cannot be sent, what is asked, state and quality, counters.
constexpr std::array wholeParts{"cortex::gui::ControlBar",    "cortex::gui::ControlNotice",
                                "cortex::gui::LifeCycleBar",  "cortex::gui::Question",
                                "cortex::gui::SimplexHeader", "cortex::gui::StatusBar"};
// It says the same in fewer words where there is little room, but never half of it.
constexpr auto inFewerWords = "cortex::gui::StopButton";

// Of these, every cell of a column, with its title.
struct WholeColumn {
    const char* table;
    int column;
};
constexpr std::array wholeColumns{
    WholeColumn{"cortex::gui::EventTable", EventModel::Time},
    WholeColumn{"cortex::gui::EventTable", EventModel::SeverityColumn},
    WholeColumn{"cortex::gui::EventTable", EventModel::Times},
    WholeColumn{"cortex::gui::ItemTable", ItemModel::Value},
    WholeColumn{"cortex::gui::ItemTable", ItemModel::Unit},
    WholeColumn{"cortex::gui::ItemTable", ItemModel::Range},
    WholeColumn{"cortex::gui::ItemTable", ItemModel::Remark},
    WholeColumn{"cortex::gui::LeaseTable", 0},  // which part
    WholeColumn{"cortex::gui::LeaseTable", 1},  // who holds it
    WholeColumn{"cortex::gui::LeaseTable", 2},  // since when
    WholeColumn{"cortex::gui::LeaseTable", 3},
    WholeColumn{"cortex::gui::AgentTable", 2},  // its state
    WholeColumn{"cortex::gui::AgentTable", 3},  // its age
    WholeColumn{"cortex::gui::RelationTable", 4},
};

QString withoutBlanks(QString text) { return text.remove(' ').remove('\n').remove('&'); }

using Painted = std::vector<PaintedText>;

// What is painted whole in a box.
QString seenIn(const QRect& box, const Painted& painted) {
    QString seen;
    for (const PaintedText& each : painted) {
        if (!box.contains(each.box.center())) continue;
        const int spare = each.box.height() / 4;  // above and below letters
        const QRect room = box.adjusted(-1, -spare, 1, spare);
        if (room.contains(each.box)) seen += each.text;
    }
    return withoutBlanks(seen);
}

bool isWhole(const QString& text, const QRect& box, const Painted& painted) {
    return seenIn(box, painted).contains(withoutBlanks(text));
}

bool isInAWholePart(const QWidget& widget) {
    for (const QWidget* each = &widget; each != nullptr; each = each->parentWidget()) {
        if (std::ranges::any_of(wholeParts, [&](const char* part) { return each->inherits(part); }))
            return true;
    }
    return false;
}

// Labels that may give way, such as a description, are not among them.
QString wholeTextOf(const QWidget& widget) {
    if (const auto* label = qobject_cast<const gui::TextLabel*>(&widget))
        return label->keepsWhole() ? label->text() : QString{};
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    return button == nullptr ? QString{} : button->text();
}

void auditParts(QWidget& window, QStringList& found) {
    for (QWidget* each : window.findChildren<QWidget*>()) {
        if (each->inherits(inFewerWords) && each->isVisible()) {
            const QString seen = seenIn(each->rect(), paintedTexts(*each));
            if (seen.isEmpty() || seen.contains(QChar{0x2026}))
                found << '"' + wholeTextOf(*each) + "\" is never to be cut";
        }
        const QString text = wholeTextOf(*each);
        if (text.isEmpty() || !each->isVisible() || !isInAWholePart(*each)) continue;
        const QRect seen = each->visibleRegion().boundingRect();
        if (seen.isEmpty()) continue;
        if (!isWhole(text, seen, paintedTexts(*each)))
            found << '"' + text + "\" is never to be cut";
    }
}

// What the cell has to show. Texts of agents and arrays may be of any length.
QStringList wholeTextsOf(const QModelIndex& cell) {
    const auto* items = qobject_cast<const ItemModel*>(cell.model());
    if (items == nullptr) return {cell.data().toString()};
    const ItemModel::Row& row = items->row(cell);
    if (row.item == nullptr) return {};
    const bool isLong = row.item->kind == Kind::String || (row.whole && row.item->length > 1);
    if (cell.column() == ItemModel::Value && isLong) return {};
    if (cell.column() == ItemModel::Remark && !row.edited.isEmpty()) return {row.value};
    if (cell.column() != ItemModel::Range) return {cell.data().toString()};
    QStringList limits;
    if (row.min) limits << gui::numberText(row.asShown(), *row.min);
    if (row.max) limits << gui::numberText(row.asShown(), *row.max);
    return limits;
}

// Rows that are seen from top to bottom.
std::vector<QModelIndex> rowsIn(const QAbstractItemView& view) {
    std::vector<QModelIndex> rows;
    const QRect seen = view.viewport()->rect();
    int y = 0;
    while (y < seen.height()) {
        const QModelIndex row = view.indexAt({1, y});
        const QRect box = view.visualRect(row);
        if (!row.isValid() || box.height() <= 0) break;
        if (box.top() >= 0 && box.bottom() <= seen.bottom()) rows.push_back(row);
        y = box.bottom() + 1;
    }
    return rows;
}

void auditColumn(QAbstractItemView& view, int column, const Painted& painted, QStringList& found) {
    const auto* header = view.findChild<QHeaderView*>();
    const QRect seen = view.viewport()->rect();
    const bool scrolls = view.horizontalScrollBarPolicy() != Qt::ScrollBarAlwaysOff;
    for (const QModelIndex& row : rowsIn(view)) {
        const QModelIndex cell = row.sibling(row.row(), column);
        const QRect box = view.visualRect(cell);
        if (box.isEmpty() || (scrolls && !seen.contains(box))) continue;
        for (const QString& text : wholeTextsOf(cell)) {
            if (!isWhole(text, box & seen, painted))
                found << "\"" + text + "\" is never to be cut, in the column " +
                             header->model()->headerData(column, Qt::Horizontal).toString();
        }
    }
}

void auditColumns(QWidget& window, QStringList& found) {
    for (auto* view : window.findChildren<QAbstractItemView*>()) {
        const auto isOf = [&](const WholeColumn& each) { return view->inherits(each.table); };
        if (!view->isVisible() || std::ranges::none_of(wholeColumns, isOf)) continue;
        const Painted painted = paintedTexts(*view->viewport());
        for (const WholeColumn& each : wholeColumns) {
            if (isOf(each)) auditColumn(*view, each.column, painted, found);
        }
    }
}

void auditTabs(QWidget& window, QStringList& found) {
    for (auto* tabs : window.findChildren<QTabBar*>()) {
        if (!tabs->isVisible()) continue;
        const Painted painted = paintedTexts(*tabs);
        for (int i = 0; i < tabs->count(); ++i) {
            const QRect box = tabs->tabRect(i);
            if (!tabs->rect().contains(box) || !tabs->tabToolTip(i).isEmpty()) continue;
            if (!isWhole(tabs->tabText(i), box, painted))
                found << "the tab " + tabs->tabText(i) + " is cut, and no tooltip has it";
        }
    }
}

}  // namespace

QStringList cutIn(QWidget& window) {
    QStringList found;
    auditParts(window, found);
    auditColumns(window, found);
    auditTabs(window, found);
    return found;
}

}  // namespace cortex::test
