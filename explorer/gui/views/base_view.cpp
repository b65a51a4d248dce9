// SPDX-License-Identifier: Apache-2.0
#include "views/base_view.hpp"

#include "common/role_meaning.hpp"
#include "model/gone_text.hpp"
#include "model/nothing_text.hpp"
#include "model/plotted_items.hpp"
#include "model/value_text.hpp"
#include "plugin/plugins.hpp"
#include "views/command_list.hpp"
#include "views/edit_bar.hpp"
#include "views/item_actions.hpp"
#include "views/life_cycle_bar.hpp"
#include "views/own_view.hpp"
#include "views/relation_table.hpp"
#include "views/simplex_header.hpp"
#include "views/type_page.hpp"
#include "views/view_host.hpp"
#include "widgets/empty_page.hpp"
#include "widgets/focus_edge.hpp"
#include "widgets/item_table.hpp"
#include "widgets/reading_order.hpp"
#include "widgets/tab_row.hpp"
#include "widgets/text_label.hpp"

#include <QShortcut>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <utility>

namespace cortex::gui {

namespace {

enum Tab { OwnTab, DataTab, RelationsTab, CommandsTab, TypeTab, TabCount };

constexpr double lowWindow = 240;  // units

constexpr std::array<std::string_view, TabCount> partNames{"own", "data", "relationships",
                                                           "commands", "type"};

}  // namespace

BaseView::BaseView(Commands& commands, ViewHost& host, const StateTimes& times, QWidget* parent)
    : QWidget{parent},
      whole_{new QStackedWidget},
      empty_{new EmptyPage},
      lifeCycle_{new LifeCycleBar{commands}},
      header_{new SimplexHeader{lifeCycle_, times}},
      tabs_{new TabRow},
      pages_{new QStackedWidget},
      own_{new OwnView{host}},
      table_{new ItemTable{items_}},
      edits_{new EditBar{commands, items_}},
      relations_{new RelationTable},
      commands_{new CommandList{commands}},
      type_{new TypePage} {
    items_.keepIn(commands.keptEdits());
    headerRow_ = new QVBoxLayout;
    headerRow_->addWidget(header_);
    makeRoom();
    connect(lifeCycle_, &LifeCycleBar::told, header_, &SimplexHeader::tell);

    pages_->setMinimumHeight(1);  // what is above them is never cut
    for (int i = 0; i < TabCount; ++i) tabs_->addTab({});
    tabs_->setAccessibleName(tr("What to show"));
    auto* dataPage = new QWidget;
    auto* dataRows = new QVBoxLayout{dataPage};
    dataRows->setContentsMargins(0, 0, 0, 0);
    dataRows->setSpacing(0);
    dataRows->addWidget(table_, 1);
    dataRows->addWidget(edits_);
    addItemActions(*table_, items_, commands.network());
    connect(table_, &ItemTable::plotWanted, this, &BaseView::plotWanted);
    connect(table_, &ItemTable::placesWanted, this, &BaseView::placesWanted);
    connect(table_, &ItemTable::compareWanted, this, &BaseView::compareWanted);
    connect(table_, &ItemTable::unitsChanged, this, &BaseView::unitsChanged);
    connect(table_, &ItemTable::submitted, edits_, &EditBar::submitFresh);
    connect(table_, &ItemTable::givenUp, edits_, &EditBar::forgetRefusal);
    connect(edits_, &EditBar::pressed, table_, qOverload<>(&QWidget::setFocus));
    auto* undo = new QShortcut{QKeySequence::Undo, this};
    connect(undo, &QShortcut::activated, edits_, &EditBar::undo);
    for (QWidget* page :
         std::initializer_list<QWidget*>{own_, dataPage, relations_, commands_, type_}) {
        pages_->addWidget(page);
    }
    connect(tabs_, &QTabBar::currentChanged, pages_, &QStackedWidget::setCurrentIndex);
    connect(tabs_, &QTabBar::tabBarClicked, this, [this](int tab) { wanted_ = tab; });
    connect(relations_, &RelationTable::opened, this, &BaseView::opened);
    connect(own_, &OwnView::opened, this, &BaseView::opened);
    connect(own_, &OwnView::selected, this, &BaseView::selected);
    connect(header_, &SimplexHeader::dismissed, this, &BaseView::dismissed);
    connect(header_, &SimplexHeader::beforeWanted, this, &BaseView::beforeWanted);
    connect(header_, &SimplexHeader::typeWanted, this, &BaseView::openType);

    auto* content = new QWidget;
    auto* rows = new QVBoxLayout{content};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addLayout(headerRow_);
    rows->addWidget(tabs_);
    rows->addWidget(pages_, 1);

    whole_->addWidget(empty_);
    whole_->addWidget(content);
    setAutoFillBackground(true);
    setProperty(wantsFocusEdge, true);  // while the keyboard waits in it
    auto* outer = new QVBoxLayout{this};
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(whole_);
}

void BaseView::show(const std::string& path) {
    path_ = path;
    fresh_ = true;
    goal_.reset();
    items_.show(path);
    lifeCycle_->show(path);
    edits_->show(path);
}

std::vector<RecordedItem> BaseView::chosenItems() const {
    const bool inTable = tabs_->currentIndex() == DataTab && table_->currentIndex().isValid();
    return plottedItems(items_, inTable ? table_->currentIndex() : items_.index(0, 0));
}

void BaseView::setUnits(const ShownUnits& units) {
    items_.setUnits(units);
    Q_EMIT unitsChanged();
}

void BaseView::openPart(const std::string& name) {
    const auto found = std::ranges::find(partNames, name);
    if (found == partNames.end()) return;
    wanted_ = static_cast<int>(found - partNames.begin());
    tabs_->setCurrentIndex(wanted_);
}

void BaseView::enter(const std::string& part, const std::string& name) {
    openPart(part);
    goal_ = name;
    if (whole_->currentIndex() == 1 && !fresh_) return reachGoal();
    setFocus(Qt::OtherFocusReason);
}

void BaseView::reachGoal() {
    const std::string name = *std::exchange(goal_, std::nullopt);
    if (tabs_->currentIndex() == DataTab && table_->choose(name)) return;
    if (tabs_->currentIndex() == CommandsTab && commands_->choose(name)) return;
    QWidget* stop = mainStop(*pages_->currentWidget());  // none: a view may have nothing for keys
    (stop != nullptr ? stop : tabs_)->setFocus(Qt::TabFocusReason);
}

void BaseView::refresh(const std::shared_ptr<const Frame>& frame) {
    const auto place = path_.empty() ? std::nullopt : frame->find(path_);
    items_.update(frame);
    whole_->setCurrentIndex(place ? 1 : 0);
    if (!place) {
        showNothing(*frame);
        fresh_ = true;
        return;
    }
    types_ = frame->agents[place->agent].structure;
    if (fresh_ || structures_ != frame->structures) refreshTabs(*frame, place);
    makeRoom();
    lifeCycle_->refresh(*frame, *place);
    header_->explain(lifeCycle_->reasons());
    header_->refresh(*frame, *place);
    edits_->refresh(frame, *place);
    commands_->refresh(*frame, *place);
    relations_->refresh(*frame);
    own_->refresh(*frame);
    fresh_ = false;
    structures_ = frame->structures;
    if (!goal_) return;  // also where somebody has gone elsewhere meanwhile
    window()->focusWidget() == this ? reachGoal() : goal_.reset();
}

bool BaseView::wantsRoom() const {
    return whole_->currentIndex() == 1 && tabs_->currentIndex() == OwnTab && own_->wantsRoom() &&
           window()->height() < Look::units(lowWindow);
}

// In a low window the header leaves a view the height that it needs.
void BaseView::makeRoom() {
    const bool brief = wantsRoom(), low = Look::isLow(*this);
    header_->setBrief(brief);
    lifeCycle_->setLines(low ? 0 : brief ? 1 : 2);
    table_->setLow(low);
    edits_->setLow(low);
    const int side = Look::units(4), above = Look::units(low ? 0.5 : brief ? 1.5 : 3);
    const QMargins margins{side, above, side, Look::units(low ? 0.5 : brief ? 1 : 2)};
    if (headerRow_->contentsMargins() != margins) headerRow_->setContentsMargins(margins);
}

// Nobody is heard, the domain cannot be joined, the path is not there, nothing is chosen.
void BaseView::showNothing(const Frame& frame) {
    if (const auto nothing = nothingText(frame)) return empty_->show(nothing->title, nothing->text);
    if (path_.empty())
        return empty_->show(tr("Choose a simplex in the tree."), tr(common::simplexMeaning));
    const GoneAgent* gone = frame.goneFrom(path_);
    const QString comes = tr("This pane fills itself when it comes.");
    empty_->show(tr("%1 is not heard.").arg(QString::fromStdString(path_)),
                 gone != nullptr ? goneText(*gone) + ' ' + comes : comes);
}

// An ancestor, in the tab of the type.
void BaseView::openType(const std::string& name) {
    const Type* type = types_ ? types_->types->find(name) : nullptr;
    if (type == nullptr) return;
    type_->show(*type, *types_->types);
    wanted_ = TypeTab;
    tabs_->setCurrentIndex(TypeTab);
}

void BaseView::refreshTabs(const Frame& frame, std::optional<Place> place) {
    const Type& type = frame.type(*place);
    const AgentFrame& agent = frame.agents[place->agent];
    header_->show(frame, *place);
    commands_->show(frame, *place);
    relations_->show(frame, *place);
    type_->show(type, *agent.structure->types);
    const auto title = [](const QString& text, int count) {
        return QStringLiteral("%1  %2").arg(text).arg(count);
    };
    tabs_->setTabText(DataTab, title(tr("Data"), static_cast<int>(type.data.size())));
    tabs_->setTabText(RelationsTab, title(tr("Relationships"), relations_->count()));
    tabs_->setTabText(CommandsTab, title(tr("Commands"), static_cast<int>(type.commands.size())));
    tabs_->setTabText(TypeTab, tr("Type"));
    showOwnView(type, *agent.structure->types);
}

// The view that a plug-in has for the type, as the first tab.
void BaseView::showOwnView(const Type& type, const TypeModel& types) {
    const ViewType* own = Plugins::all().viewFor(type, types);
    if (own == nullptr) {
        own_->clear();
    } else {
        own_->show(*own, path_);
        tabs_->setTabText(OwnTab, QString::fromUtf8(own->title));
    }
    tabs_->offer(OwnTab, own != nullptr);
    tabs_->setCurrentIndex(wanted_ == OwnTab && own == nullptr ? DataTab : wanted_);
}

}  // namespace cortex::gui
