// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"
#include "session/commands.hpp"

#include <QMenu>
#include <QTabBar>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class QLayout;
class QStackedWidget;

namespace cortex::gui {

class ItemTable;
class OwnView;
class RelationTable;
class CommandList;
class EmptyPage;
class EditBar;
class LifeCycleBar;
class TypePage;
class SimplexHeader;
class StateTimes;
class TabRow;
class ViewHost;

// What can be said of every simplex, whatever its type: state, data, relationships, commands, type.
class BaseView : public QWidget {
    Q_OBJECT
public:
    BaseView(Commands& commands, ViewHost& host, const StateTimes& times,
             QWidget* parent = nullptr);

    void show(const std::string& path);
    const std::string& path() const { return path_; }
    void refresh(const std::shared_ptr<const Frame>& frame);
    void openPart(const std::string& name);  // "data", "relationships", "commands", "type"
    // Puts the keyboard into what is shown, as soon as it is there: into the part, at the item or
    // command of this name. Without a part, where one works in the tab that is in front.
    void enter(const std::string& part = {}, const std::string& name = {});
    const ShownUnits& units() const { return items_.units(); }  // of the table of data
    void setUnits(const ShownUnits& units);
    // The row of data that is chosen, otherwise all numbers of its own type that are not constant.
    std::vector<RecordedItem> chosenItems() const;
    OwnView& own() { return *own_; }  // of a plug-in, where there is one
    // The view in front needs the height of what else the window shows, and the window is low.
    bool wantsRoom() const;

Q_SIGNALS:
    void opened(const std::string& path);    // the user followed a link
    void selected(const std::string& path);  // in the view of a plug-in
    void beforeWanted(const comms::AgentEvent& fault);
    void plotWanted(const std::vector<RecordedItem>& items);
    void placesWanted(QMenu* menu, const std::vector<RecordedItem>& items);
    void compareWanted(const QString& item);
    void unitsChanged();
    void dismissed(const std::string& agent);  // a lost agent may go

private:
    void openType(const std::string& name);
    void refreshTabs(const Frame& frame, std::optional<Place> place);
    void showOwnView(const Type& type, const TypeModel& types);
    void makeRoom();
    void showNothing(const Frame& frame);
    void reachGoal();

    std::string path_;
    std::uint64_t structures_ = 0;
    bool fresh_ = true;  // another path is shown since the last frame
    ItemModel items_;
    QStackedWidget* whole_;
    EmptyPage* empty_;
    LifeCycleBar* lifeCycle_;
    SimplexHeader* header_;
    QLayout* headerRow_;
    std::shared_ptr<const Structure> types_;  // of what is shown
    TabRow* tabs_;
    int wanted_ = 0;                   // tab that the user chose
    std::optional<std::string> goal_;  // item or command for the keyboard, which waits in the view
    QStackedWidget* pages_;
    OwnView* own_;
    ItemTable* table_;
    EditBar* edits_;
    RelationTable* relations_;
    CommandList* commands_;
    TypePage* type_;
};

}  // namespace cortex::gui
