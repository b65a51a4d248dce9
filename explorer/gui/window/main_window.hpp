// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/event_filter.hpp"
#include "model/state_times.hpp"
#include "session/commands.hpp"
#include "views/manual_view.hpp"
#include "window/arrangement.hpp"

#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <optional>
#include <string>

class QBoxLayout;
class QMenu;
class QPushButton;
class QSplitter;
class QStackedWidget;
class QTabBar;

namespace cortex::explorer {

class AgentTable;
class BaseView;
class ControlBar;
class EventList;
class EventView;
class GraphView;
class StatusBar;
class StopButton;
class SystemTree;
class TextLabel;

// The window: the tree of simplexes, tabs with views, events, status. It takes the newest frame of
// the session 30 times a second and waits for nothing.
class MainWindow : public QWidget {
    Q_OBJECT
public:
    explicit MainWindow(Session& session, QWidget* parent = nullptr);

    void open(const std::string& path);     // in the current tab, or in one of its own
    void openTab(const std::string& path);  // in one of its own
    void openAgents();
    void openManual();  // at what is said about what has the keyboard
    ManualView* manual() { return manual_; }
    void openGraph();
    void openEvents();
    void openPart(const std::string& name);  // of the simplex that is shown
    StopButton& stopButton() { return *stop_; }
    ControlBar& control() { return *control_; }
    bool ready() const;  // everything has come, with the values that are shown
    void refresh();      // with the newest frame
    SystemTree& tree() { return *tree_; }
    QWidget* current() const;
    Arrangement& arrangement() { return arrangement_; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void closeEvent(QCloseEvent* event) override;  // asks first while it is in control
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;  // another size of text

private:
    QWidget* makeBar();
    void addRates(QMenu& menu);
    void addKeys();
    BaseView* addView(const std::string& path, bool closable);
    void closeTab(int tab);
    void openAbnormal(bool back, std::optional<Abnormal::Kind> kind = {});
    void setTheme(int step);
    void setScale(double scale);
    void restyle();
    void arrange();
    void showStrip();  // unless the tab of events is in front

    Session& session_;
    Commands commands_;
    EventModel events_;
    EventFilter eventFilter_{events_};  // one for all that show events
    StateTimes times_;
    Abnormal abnormal_;
    SystemTree* tree_;
    QTabBar* tabs_;
    QStackedWidget* views_;
    GraphView* graph_;
    AgentTable* agents_;
    QPointer<ManualView> manual_;
    EventView* eventView_;
    EventList* eventList_;
    QSplitter *across_, *down_;
    StatusBar* status_;
    QPushButton* menu_;
    QBoxLayout* barRow_ = nullptr;
    TextLabel* title_;
    StopButton* stop_;
    bool strip_ = true;        // wanted
    bool leaves_ = false;      // the user said so
    bool refreshing_ = false;  // just now
    ControlBar* control_;
    Arrangement arrangement_;
    QTimer timer_;
};

}  // namespace cortex::explorer
