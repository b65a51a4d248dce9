// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include "record/recorded_item.hpp"
#include "session/frame.hpp"
#include "widgets/unit_menu.hpp"

#include <QJsonObject>
#include <QPointer>
#include <QString>
#include <QWidget>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class QBoxLayout;
class QStackedWidget;
class QTabBar;

namespace cortex::gui {

class DropZone;
class TabRow;

// Whose values a page needs: at the rate that the user has set, and at rates of its own.
struct Wanted {
    std::vector<std::string> usual{};
    std::vector<explorer::Watch> own{};
};

// What a tab shows.
struct Page {
    QString kind;  // "simplex", "system", …; with what `saved` says it can be made again
    QWidget* widget = nullptr;
    std::function<void(const std::shared_ptr<const Frame>&)> refresh{};  // while it is seen
    std::function<QJsonObject()> saved{};
    std::function<Wanted(const Frame&)> wanted{};         // while it is seen; none: states alone
    UnitsOfView units{};                                  // without functions: it shows none
    std::function<std::vector<RecordedItem>()> chosen{};  // that can be plotted
    bool closable = true;                                 // with a button of its own
    bool stays = false;                                   // cannot be closed at all
    bool pinned = false;                                  // of a simplex: it keeps what it shows
    bool goesOn = false;                                  // refreshed also behind another tab
};

// Tabs with what they show. Tabs are moved by the mouse, closed by button, key, middle click and
// menu.
class Pane : public QWidget {
    Q_OBJECT
public:
    explicit Pane(const QString& name, QWidget* parent = nullptr);

    void addLeft(QWidget& widget);  // before the tabs
    int add(Page page, const QString& title, int at);
    Page take(int tab);  // its widget belongs to nobody then
    void close(int tab);
    void discard(int tab);  // without being asked, and for good
    void choose(int tab);
    void goBack();  // to the tab that was in front before
    void setTitle(int tab, const QString& title);
    void setPinned(int tab, bool pinned);
    void restyle();  // after another theme

    int count() const { return static_cast<int>(pages_.size()); }
    int chosen() const;
    int find(const QString& kind) const;  // -1: there is none
    const Page& page(int tab) const { return pages_[static_cast<std::size_t>(tab)]; }
    const Page* current() const;  // null: it is empty
    QString title(int tab) const;
    QTabBar& tabs();
    const DropZone& zone() const { return *zone_; }
    QWidget& content();

Q_SIGNALS:
    void changed();            // something that a layout keeps
    void currentChanged();     // another tab is in front
    void touched();            // the user has begun to work in it
    void closing(int tab);     // just before it goes
    void moveWanted(int tab);  // to the other pane
    // Values were dropped on this tab; -1: on none of a plot.
    void itemsDropped(const std::vector<RecordedItem>& items, int tab);

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void decorate(int tab);
    void openMenu(const QPoint& at);
    bool dragOver(QEvent& event);
    int plotAt(const QPoint& at) const;
    void showCurrent();
    Page& at(int tab) { return pages_[static_cast<std::size_t>(tab)]; }

    std::vector<Page> pages_;  // in the order of the tabs
    QBoxLayout* top_;
    TabRow* tabs_;
    QStackedWidget* content_;
    QPointer<QWidget> before_;  // that was in front
    DropZone* zone_;            // on the tabs, while values are dragged over them
};

}  // namespace cortex::gui
