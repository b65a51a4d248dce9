// SPDX-License-Identifier: Apache-2.0
#include "views/compare_view.hpp"

#include "model/whole_file.hpp"
#include "style/look.hpp"
#include "widgets/filter_keys.hpp"
#include "widgets/range_bar.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"
#include "widgets/unit_menu.hpp"

#include <QAction>
#include <QCompleter>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace cortex::gui {

namespace {

constexpr qint64 orderEvery = 2'000;  // ms
constexpr int mostPlotted = 8;
constexpr std::array<double, 6> compareWidths{70, 28, 14, 50, 46, 18};  // units

class CompareDelegate : public QStyledItemDelegate {
public:
    CompareDelegate(const CompareModel& rows, QObject* parent)
        : QStyledItemDelegate{parent}, rows_{rows} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(10), rowHeight()};
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const CompareModel::Row& row = rows_.row(index.row());
        const Tokens& c = Look::colours();
        const QRect box = option.rect.adjusted(Look::units(2), 0, -Look::units(2), 0);
        const bool outside = row.outside;
        const QColor plain = outside ? c.warnText : row.live || row.constant ? c.ink : c.dataText;
        paintRow(*painter, option);
        if (index.column() == CompareModel::Range) {
            const auto number = row.number ? std::optional{row.number->near()} : std::nullopt;
            if (row.min && row.max)
                paintRange(*painter, box, {*row.min, *row.max, number, row.live});
            return;
        }
        const bool right = index.column() == CompareModel::Value ||
                           index.column() == CompareModel::Distance ||
                           index.column() == CompareModel::Age;
        const bool quiet =
            index.column() == CompareModel::Unit || index.column() == CompareModel::Path;
        paintText(*painter, box, index.data().toString(), rowInk(option, quiet ? c.ink : plain),
                  right ? Qt::AlignRight : Qt::AlignLeft,
                  outside && index.column() == CompareModel::Value);
    }

private:
    const CompareModel& rows_;
};

}  // namespace

CompareView::CompareView(QWidget* parent)
    : QWidget{parent},
      rows_{new CompareModel{this}},
      item_{new QLineEdit},
      filter_{new QLineEdit},
      plot_{new QPushButton},
      export_{new QPushButton{tr("CSV…")}},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      note_{new TextLabel{TextSize::Note, false, &Tokens::ink2}},
      table_{new QTreeView} {
    table_->setModel(rows_);
    table_->setItemDelegate(new CompareDelegate{*rows_, table_});
    setUpRows(*table_);
    setWidths(*table_, compareWidths);
    table_->setRootIsDecorated(false);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setSortingEnabled(true);
    table_->sortByColumn(CompareModel::Distance, Qt::AscendingOrder);
    table_->setAccessibleName(tr("One item of many simplexes"));
    addMenu();
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addWidget(makeBar());
    rows->addWidget(table_, 1);
    setAutoFillBackground(true);
    connect(item_, &QLineEdit::editingFinished, this, &CompareView::search);
    connect(filter_, &QLineEdit::textChanged, this, &CompareView::search);
    joinFilter(*filter_, *table_);
    connect(plot_, &QPushButton::clicked, this, [this] {
        if (const auto items = chosenItems(); !items.empty()) Q_EMIT plotWanted(items);
    });
    connect(export_, &QPushButton::clicked, this, &CompareView::askForFile);
    connect(table_, &QTreeView::activated, this,
            [this](const QModelIndex& index) { Q_EMIT opened(rows_->recorded(index.row()).path); });
}

// A field that has the focus ends its editing while its view goes, when there is no search any
// more.
CompareView::~CompareView() {
    for (const QLineEdit* each : {item_, filter_}) each->disconnect(this);
}

void CompareView::addMenu() {
    auto* plot = new QAction{tr("Plot"), this};
    connect(plot, &QAction::triggered, plot_, &QPushButton::click);
    auto* places = new QMenu{tr("Plot in…"), this};
    connect(places, &QMenu::aboutToShow, this, [this, places] {
        places->clear();
        Q_EMIT placesWanted(places, chosenItems());
    });
    auto* shown = new QMenu{tr("Units"), this};
    fillUnitMenu(*shown, [this] {
        return UnitsOfView{[this] { return units(); },
                           [this](const ShownUnits& chosen) { setUnits(chosen); }};
    });
    table_->addActions({plot, places->menuAction(), shown->menuAction()});
    table_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

QWidget* CompareView::makeBar() {
    auto* bar = new QWidget;
    auto* lines = new QVBoxLayout{bar};
    lines->setContentsMargins(Look::units(4), Look::units(2), Look::units(4), Look::units(2));
    auto* row = new QHBoxLayout;
    item_->setAccessibleName(tr("Item that is compared"));
    item_->setPlaceholderText(tr("Item, such as position"));
    item_->setFixedWidth(Look::units(60));
    filter_->setPlaceholderText(tr("Of all; or is:AxisConcept, in:/arm …"));
    filter_->setAccessibleName(tr("Of which simplexes"));
    row->addWidget(item_);
    row->addWidget(filter_, 1);
    row->addWidget(count_);
    row->addWidget(plot_);
    row->addWidget(export_);
    lines->addLayout(row);
    lines->addWidget(note_);
    return bar;
}

void CompareView::compare(const std::string& item, const QString& filter) {
    const QSignalBlocker quiet{filter_};
    item_->setText(QString::fromStdString(item));
    filter_->setText(filter);
    search();
}

void CompareView::search() {
    exported_.clear();
    const std::string item = item_->text().trimmed().toStdString();
    if (item != rows_->item() || filter_->text() != rows_->filter()) {
        const bool other = item != rows_->item();
        rows_->compare(item, filter_->text());
        if (other) setWidths(*table_, compareWidths);  // it is the title of a column
    }
}

// The pointer, the keyboard or a selection in the table holds its order.
bool CompareView::isHeld() const {
    return table_->underMouse() || table_->hasFocus() || table_->selectionModel()->hasSelection();
}

void CompareView::refresh(const std::shared_ptr<const Frame>& frame) {
    if (structures_ != frame->structures) {
        auto* names = new QCompleter{comparableItems(*frame), item_};
        names->setCaseSensitivity(Qt::CaseInsensitive);
        names->setFilterMode(Qt::MatchContains);
        connect(names, qOverload<const QString&>(&QCompleter::activated), this,
                [this] { search(); });
        item_->setCompleter(names);  // which deletes the one before
        structures_ = frame->structures;
    }
    const bool due = !ordered_.isValid() || ordered_.elapsed() >= orderEvery;
    rows_->update(frame, due && !isHeld());
    if (due) ordered_.start();
    heard_ = std::ranges::any_of(frame->agents,
                                 [](const AgentFrame& each) { return each.structure != nullptr; });
    growColumns();
    tell();
}

// No number that is seen is cut: it would read as another one. Columns become narrower no more.
void CompareView::growColumns() {
    const QModelIndex top = table_->indexAt({0, 0});
    const QModelIndex bottom = table_->indexAt({0, table_->viewport()->height() - 1});
    const int first = std::max(top.row(), 0);
    const int last = bottom.isValid() ? bottom.row() : rows_->rowCount() - 1;
    for (const int column : {CompareModel::Value, CompareModel::Distance, CompareModel::Age}) {
        int needed = 0;
        for (int row = first; row <= last; ++row) {
            const CompareModel::Row& each = rows_->row(row);
            if (column == CompareModel::Value && !each.number) continue;  // texts may be long
            const bool strong = each.outside && column == CompareModel::Value;
            const QString text = rows_->index(row, column).data().toString();
            needed = std::max(needed, textWidth(text, strong) + Look::units(5));
        }
        if (needed > table_->columnWidth(column)) table_->setColumnWidth(column, needed);
    }
}

void CompareView::tell() {
    const int count = rows_->rowCount();
    const int chosen = table_->selectionModel()->selectedRows().size();
    count_->show(tr("%n rows", nullptr, count));
    plot_->setText(chosen > 0 ? tr("Plot %1 chosen").arg(std::min(chosen, mostPlotted))
                              : tr("Plot first %1").arg(std::min(count, mostPlotted)));
    plot_->setEnabled(count > 0);
    export_->setEnabled(count > 0);
    if (!rows_->trouble().isEmpty()) {
        note_->show(rows_->trouble());
    } else if (rows_->item().empty()) {
        note_->show(tr("Choose an item: it is shown for every simplex that has it."));
    } else if (count == 0 && !heard_) {
        note_->show(tr("Nothing is heard yet."));
    } else if (count == 0) {
        note_->show(rows_->filter().trimmed().isEmpty()
                        ? tr("No simplex has %1.").arg(QString::fromStdString(rows_->item()))
                        : tr("Nothing that matches \"%1\" has %2.")
                              .arg(rows_->filter(), QString::fromStdString(rows_->item())));
    } else if (!exported_.isEmpty()) {
        note_->show(exported_);
    } else {
        note_->show(isHeld() ? tr("The order is held while the table is used.")
                             : tr("The order is looked at every 2 s. Enter opens a row."));
    }
}

std::vector<RecordedItem> CompareView::chosenItems() const {
    std::vector<RecordedItem> items;
    for (const QModelIndex& each : table_->selectionModel()->selectedRows()) {
        if (items.size() < mostPlotted) items.push_back(rows_->recorded(each.row()));
    }
    const int first = items.empty() ? std::min(rows_->rowCount(), mostPlotted) : 0;
    for (int each = 0; each < first; ++each) items.push_back(rows_->recorded(each));
    return items;
}

QString CompareView::exportTo(const QString& name) const {
    return writeWholeFile(name, QByteArray::fromStdString(rows_->csv()));
}

void CompareView::askForFile() {
    const QString file = QFileDialog::getSaveFileName(this, tr("Export"), {}, tr("Table (*.csv)"));
    if (file.isEmpty()) return;
    const QString why = exportTo(file);
    exported_ = why.isEmpty() ? tr("%1 was written.").arg(file)
                              : tr("%1 was not written: %2.").arg(file, why);
}

QJsonObject CompareView::saved() const {
    return {{QStringLiteral("item"), QString::fromStdString(rows_->item())},
            {QStringLiteral("filter"), rows_->filter()},
            {QStringLiteral("column"), table_->header()->sortIndicatorSection()},
            {QStringLiteral("units"), units().saved()},
            {QStringLiteral("descending"),
             table_->header()->sortIndicatorOrder() == Qt::DescendingOrder}};
}

void CompareView::setUnits(const ShownUnits& units) {
    rows_->setUnits(units);
    Q_EMIT unitsChanged();
}

void CompareView::restore(const QJsonObject& saved) {
    rows_->setUnits(ShownUnits::restored(saved[QStringLiteral("units")].toArray()));
    const int column = saved[QStringLiteral("column")].toInt(CompareModel::Distance);
    if (column >= 0 && column < CompareModel::ColumnCount) {
        table_->sortByColumn(column, saved[QStringLiteral("descending")].toBool()
                                         ? Qt::DescendingOrder
                                         : Qt::AscendingOrder);
    }
    compare(saved[QStringLiteral("item")].toString().toStdString(),
            saved[QStringLiteral("filter")].toString());
}

}  // namespace cortex::gui
