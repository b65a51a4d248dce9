// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/item_model.hpp"
#include "session/commands.hpp"

#include <QTabBar>
#include <QWidget>
#include <memory>
#include <string>
#include <vector>

class QStackedWidget;

namespace cortex::explorer {

class ItemTable;
class OwnView;
class RelationTable;
class CommandList;
class EditBar;
class LifeCycleBar;
class TypePage;
class SimplexHeader;
class StateTimes;
class TextLabel;

// What can be said of every simplex, whatever its type: state, data, relationships, commands, type.
class BaseView : public QWidget {
    Q_OBJECT
public:
    BaseView(Commands& commands, const StateTimes& times, QWidget* parent = nullptr);

    void show(const std::string& path);
    const std::string& path() const { return path_; }
    void refresh(const std::shared_ptr<const Frame>& frame);
    void openPart(const std::string& name);  // "data", "relationships", "commands", "type"

Q_SIGNALS:
    void opened(const std::string& path);      // the user followed a link
    void dismissed(const std::string& agent);  // a lost agent may go

private:
    void openType(const std::string& name);
    void refreshTabs(const Frame& frame, std::optional<Place> place);
    void showOwnView(const Type& type, const TypeModel& types);
    void showNothing(const Frame& frame);

    std::string path_;
    std::uint64_t structures_ = 0;
    bool fresh_ = true;  // another path is shown since the last frame
    ItemModel items_;
    QStackedWidget* whole_;
    TextLabel *emptyTitle_, *emptyText_;
    TextLabel* outcome_;
    LifeCycleBar* lifeCycle_;
    SimplexHeader* header_;
    std::shared_ptr<const Structure> types_;  // of what is shown
    QTabBar* tabs_;
    int wanted_ = 0;  // tab that the user chose
    QStackedWidget* pages_;
    OwnView* own_;
    ItemTable* table_;
    EditBar* edits_;
    RelationTable* relations_;
    CommandList* commands_;
    TypePage* type_;
};

}  // namespace cortex::explorer
