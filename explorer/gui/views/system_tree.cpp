// SPDX-License-Identifier: Apache-2.0
#include "views/system_tree.hpp"

#include "model/plotted_items.hpp"
#include "style/glyphs.hpp"
#include "widgets/item_drag.hpp"
#include "widgets/row_note.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QAction>
#include <QDrag>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>
#include <utility>

namespace cortex::gui {

namespace {

class TreeDelegate : public QStyledItemDelegate {
public:
    TreeDelegate(const SystemModel& model, QObject* parent)
        : QStyledItemDelegate{parent}, model_{model} {}

    QSize sizeHint(const QStyleOptionViewItem& /*option*/,
                   const QModelIndex& /*index*/) const override {
        return {Look::units(20), rowHeight()};
    }

    // Shape and name, and at the right end the type or the state with its mark.
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        const Tokens& c = Look::colours();
        const Marks& marks = model_.marks(index);
        const bool selected = option.state.testFlag(QStyle::State_Selected);
        const Tokens& drawn = selected && Look::theme() == Theme::HighContrast ? onSelection() : c;
        const int size = markSize(), gap = Look::units(2);
        QRect box = option.rect.adjusted(Look::units(1), 0, -Look::units(3), 0);
        const auto mark = [&](Shape shape, int left) {
            gui::paint(*painter, markBox(left, box, size), shape, drawn);
        };
        mark(marks.shape, box.left());
        box.setLeft(box.left() + size + gap);

        const auto shown = marks.own ? marks.own : marks.worst;
        if (shown) {
            mark(*shown, box.right() - size);
            box.setRight(box.right() - size - gap);
        }
        const QString name = index.data().toString();
        const int nameWidth = textWidth(name);
        paintText(*painter, box, name, rowInk(option, c.ink));
        box.setLeft(box.left() + std::min(nameWidth, box.width()) + gap);
        QString text = index.data(SystemModel::WordRole).toString();
        QColor ink = marks.shape == Shape::Fault ? c.faultText : c.ink2;
        if (marks.own) {
            const QString quality = word(*marks.own);
            const int width = textWidth(quality);
            paintText(*painter, box, quality, rowInk(option, textColour(*marks.own, c)),
                      Qt::AlignRight);
            box.setRight(box.right() - width - gap);
        }
        paintText(*painter, box, text, rowInk(option, ink), Qt::AlignRight);
    }

private:
    static const Tokens& onSelection() {
        static const Tokens all = [] {
            Tokens t = tokens(Theme::HighContrast);
            for (QColor Tokens::* each :
                 {&Tokens::ink, &Tokens::ink2, &Tokens::data, &Tokens::warnEdge, &Tokens::fault}) {
                t.*each = t.onAccent;
            }
            t.onFault = t.accent;
            return t;
        }();
        return all;
    }

    const SystemModel& model_;
};

}  // namespace

// Knows whether a person is acting just now: rows that come and go move the current row, too.
// A press may begin a drag: what is chosen by the mouse is told when the button is up again.
// While the pointer is over it, it scrolls further than its rows reach, to keep one in its place.
class TreeRows : public QTreeView {
public:
    explicit TreeRows(const SystemModel& model) : items_{model} {
        setDragEnabled(true);
        setDragDropMode(DragOnly);
        other_.setSingleShot(true);
        other_.setInterval(1000);
    }
    bool acts() const { return acts_; }
    bool presses() const { return presses_; }

    // The row under the pointer stays there. Where it goes, presses are not meant for the next one.
    void keepPlace(const std::function<void()>& change) {
        const QPersistentModelIndex row = underPointer();
        const int place = viewport()->y() + visualRect(row).top();
        change();
        if (row.isValid() && viewport()->y() + visualRect(row).top() != place) {
            const int beyond = verticalScrollBar()->value() + visualRect(row).top() - place;
            scrollBeyond(beyond, std::max(beyond, 0));
        }
        if (underPointer() != row) other_.start();
    }
    void forgetPlace() {
        if (beyond_ != 0) scrollBeyond(0, verticalScrollBar()->value());
    }

protected:
    bool viewportEvent(QEvent* event) override {
        if (event->type() == QEvent::Leave) forgetPlace();
        return isOfOther(*event) || QTreeView::viewportEvent(event);
    }
    void updateGeometries() override {
        if (fits_) return;  // the margin resizes the viewport
        const QScopedValueRollback fit{fits_, true};
        QScrollBar& bar = *verticalScrollBar();
        const int value = bar.value(), margin = std::max(-beyond_, 0);
        QTreeView::updateGeometries();
        if (beyond_ == 0) return;
        setViewportMargins(0, margin, 0, 0);
        bar.setMaximum(std::max(bar.maximum() + margin, beyond_));
        bar.setValue(value);
    }
    void keyPressEvent(QKeyEvent* event) override {
        const QScopedValueRollback act{acts_, true};
        QTreeView::keyPressEvent(event);
    }
    void mousePressEvent(QMouseEvent* event) override {
        if (event->button() == Qt::RightButton) return;  // its menu chooses nothing first
        const QScopedValueRollback act{acts_, true};
        const QScopedValueRollback press{presses_, true};
        QTreeView::mousePressEvent(event);
    }
    void startDrag(Qt::DropActions /*actions*/) override {
        const auto dragged = plottedItems(items_.frame(), items_.path(currentIndex()));
        if (dragged.empty()) return;
        auto* drag = new QDrag{this};
        drag->setMimeData(mimeOf(dragged));
        drag->exec(Qt::CopyAction);
    }
    void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                 const QModelIndex& index) const override {
        QStyleOptionViewItem whole = option;
        whole.rect.setLeft(0);
        if (selectionModel()->isSelected(index)) whole.state |= QStyle::State_Selected;
        paintRow(*painter, whole);
        if (whole.state.testFlag(QStyle::State_Selected)) {
            painter->fillRect(QRect{0, option.rect.top(), 3, option.rect.height()},
                              Look::colours().accent);
        }
        QTreeView::drawRow(painter, option, index);
    }

private:
    QModelIndex underPointer() const {
        if (!viewport()->underMouse()) return {};
        return indexAt(viewport()->mapFromGlobal(QCursor::pos()));
    }
    void scrollBeyond(int beyond, int value) {
        beyond_ = beyond;
        setVerticalScrollBarPolicy(beyond == 0 ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOn);
        updateGeometries();
        verticalScrollBar()->setValue(value);
    }
    // Of a press where another row has just been, until its button is up.
    bool isOfOther(const QEvent& event) {
        switch (event.type()) {
            case QEvent::MouseButtonPress:
            case QEvent::MouseButtonDblClick:
                return ignores_ = other_.isActive();
            case QEvent::MouseMove:
                return ignores_ && static_cast<const QMouseEvent&>(event).buttons() != Qt::NoButton;
            case QEvent::MouseButtonRelease:
                return std::exchange(ignores_, false);
            case QEvent::ContextMenu:
                return other_.isActive();
            default:
                return false;
        }
    }

    const SystemModel& items_;
    bool acts_ = false, presses_ = false, ignores_ = false, fits_ = false;
    int beyond_ = 0;  // value of the scroll bar, with a margin above the rows where it is below 0
    QTimer other_{this};  // since another row is under the pointer
};

SystemTree::SystemTree(QWidget* parent)
    : QWidget{parent},
      tree_{makeRows()},
      filter_{new QLineEdit},
      head_{new QHBoxLayout},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      trouble_{new RowNote{*tree_}} {
    auto* title = new TextLabel{TextSize::Text, true};
    title->show(tr("Simplexes"));
    title->keepWhole();  // the count gives way
    head_->setContentsMargins(Look::units(3), Look::units(2), Look::units(3), 0);
    head_->setSpacing(Look::units(3));
    head_->addWidget(title);
    head_->addStretch(1);
    head_->addWidget(count_);

    filter_->setPlaceholderText(tr("Filter: name, is:AxisConcept, fault"));
    filter_->setAccessibleName(tr("Filter"));
    filter_->setClearButtonEnabled(true);
    filter_->setTextMargins(Look::units(1), 0, Look::units(1), 0);
    setAutoFillBackground(true);
    auto* box = new QVBoxLayout;
    box->setContentsMargins(Look::units(3), Look::units(2), Look::units(3), Look::units(2));
    box->addWidget(filter_);
    setFocusProxy(tree_);

    tree_->setItemDelegate(new TreeDelegate{model_, tree_});
    setUpRows(*tree_);
    tree_->setHeaderHidden(true);
    tree_->setAccessibleName(tr("Simplexes"));
    tree_->setExpandsOnDoubleClick(false);
    tree_->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(tree_, &QTreeView::customContextMenuRequested, this, &SystemTree::askMenu);

    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addLayout(head_);
    rows->addLayout(box);
    rows->addWidget(tree_, 1);

    connect(this, &SystemTree::chosen, this, &SystemTree::left);
    connect(this, &SystemTree::pinned, this, &SystemTree::left);
    connect(filter_, &QLineEdit::textChanged, this, &SystemTree::useFilter);
    // Also the row that is chosen already, which may be behind another tab.
    connect(tree_, &QTreeView::clicked, this, [this](const QModelIndex& index) {
        if (model_.place(index) && model_.path(index) == current_) Q_EMIT chosen(current_);
    });
    connect(tree_, &QTreeView::activated, this, [this](const QModelIndex& index) {
        if (!model_.place(index)) return;
        coversViews() ? Q_EMIT chosen(model_.path(index)) : Q_EMIT pinned(model_.path(index));
    });
}

void SystemTree::addLeft(QWidget& back) {
    head_->insertWidget(0, &back);
    back_ = &back;
}

// Then a step of a key opens nothing, as what is opened takes the place of the tree.
bool SystemTree::coversViews() const { return back_ != nullptr && back_->isVisible(); }

void SystemTree::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Escape) return QWidget::keyPressEvent(event);
    if (filter_->hasFocus() && !filter_->text().isEmpty()) return filter_->clear();
    Q_EMIT left();
}

TreeRows* SystemTree::makeRows() {
    auto* rows = new TreeRows{model_};
    rows->setModel(&model_);
    connect(rows->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this, rows](const QModelIndex& now) {
                if (!rows->acts() || !now.isValid()) return;
                current_ = model_.path(now);
                if (!model_.place(now) || rows->presses() || coversViews()) return;
                Q_EMIT chosen(std::string{current_});
            });
    return rows;
}

// By a key the menu is that of the current row.
void SystemTree::askMenu(const QPoint& at) {
    QModelIndex index = tree_->indexAt(at);
    if (!index.isValid()) index = tree_->currentIndex();
    if (!index.isValid()) return;
    Q_EMIT menuWanted(model_.path(index), tree_->viewport()->mapToGlobal(at));
}

void SystemTree::refresh(std::shared_ptr<const Frame> frame) {
    tree_->keepPlace([&] {
        model_.update(std::move(frame));
        if (!current_.empty()) keepCurrent();
        if (!opened_ && model_.rowCount() > 0) openFirstLevels();
        if (!wanted_.empty()) choose(std::exchange(wanted_, {}));
    });
    tellTrouble();
    tellCount();
}

// What a person made the current row stays it, and no other becomes it, while rows come and go.
void SystemTree::keepCurrent() {
    const QModelIndex index = model_.indexOf(current_);
    if (index == tree_->currentIndex()) return;
    if (index.isValid()) {
        tree_->setCurrentIndex(index);
    } else {
        tree_->selectionModel()->clear();
    }
}

// Depth 2 at first; later what the user opens and closes stays as it is.
void SystemTree::openFirstLevels() {
    opened_ = true;
    for (int i = 0; i < model_.rowCount(); ++i) {
        const QModelIndex top = model_.index(i, 0);
        if (model_.marks(top).shape != Shape::Agent) tree_->expandRecursively(top, 1);
    }
}

void SystemTree::choose(const std::string& path) {
    const QModelIndex index = model_.indexOf(path);
    if (!index.isValid()) {
        wanted_ = path;
        return;
    }
    for (QModelIndex above = index.parent(); above.isValid(); above = above.parent()) {
        tree_->expand(above);
    }
    current_ = path;
    tree_->setCurrentIndex(index);
    tree_->scrollTo(index);
}

std::string SystemTree::meant(const std::string& shown) const {
    const QModelIndex index = current_.empty() ? QModelIndex{} : model_.indexOf(current_);
    if (!index.isValid()) return shown;
    return shown.empty() || !model_.place(index) ? current_ : shown;
}

void SystemTree::filter(const QString& text) { filter_->setText(text); }

void SystemTree::focusFilter() {
    filter_->setFocus(Qt::ShortcutFocusReason);
    filter_->selectAll();
}

void SystemTree::useFilter() {
    tree_->forgetPlace();
    Query query{filter_->text()};
    filtered_ = !query.empty();
    model_.setFilter(std::move(query));
    if (filtered_) tree_->expandAll();
    if (!current_.empty()) keepCurrent();
    tellTrouble();
    tellCount();
}

// Of all agents, or how many of those the filter shows.
void SystemTree::tellCount() {
    const auto agents = static_cast<int>(model_.frame().agents.size());
    count_->show(filtered_ ? tr("%1 of %2 shown").arg(model_.matching()).arg(model_.simplexes())
                           : tr("%1 of %n agents", nullptr, agents).arg(model_.simplexes()));
}

// What is wrong with the filter, or that it finds nothing, for as long as that is true.
void SystemTree::tellTrouble() {
    QString trouble = model_.filter().troubleIn(model_.frame());
    if (trouble.isEmpty() && filtered_ && model_.simplexes() > 0 && model_.rowCount() == 0) {
        trouble = tr("Nothing matches \"%1\".").arg(filter_->text());
    }
    trouble_->show(trouble);
}

}  // namespace cortex::gui
