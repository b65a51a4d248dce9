// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/abnormal.hpp"
#include "model/event_filter.hpp"
#include "model/event_past.hpp"
#include "model/find_index.hpp"
#include "model/state_times.hpp"
#include "session/commands.hpp"
#include "views/manual_view.hpp"
#include "views/view_host.hpp"
#include "window/arrangement.hpp"
#include "window/leaving.hpp"
#include "window/orders.hpp"
#include "window/regions.hpp"

#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <optional>
#include <string>
#include <vector>

class QMenu;
class QSplitter;

namespace cortex::gui {

class ControlBar;
class EventList;
class FindPanel;
class LayoutKeeper;
class StatusBar;
class FocusEdge;
class StopButton;
class SystemTree;
class TopBar;
class Workspace;

// The window: the tree of simplexes, tabs with views, events, status. It takes the newest frame of
// the session 30 times a second and waits for nothing.
class MainWindow : public QWidget {
    Q_OBJECT
public:
    explicit MainWindow(Session& session, QWidget* parent = nullptr);

    void open(const std::string& path);     // where what is chosen is shown
    void openTab(const std::string& path);  // in one of its own, with the keyboard
    void reopenTab();
    void openKind(const QString& kind);  // "system", "agents", "events", "view:NAME", …
    void openPlot(const std::vector<RecordedItem>& items);  // in the last plot, or a new one
    void plotChosen();                                      // in the view in front
    void openManual();  // at what is said about what has the keyboard
    ManualView* manual() { return manual_; }
    void split();                            // side by side; the keyboard goes with the tab
    void openPart(const std::string& name);  // of the simplex that is shown
    Workspace& workspace() { return *workspace_; }
    void find();                   // opens the field that finds everything
    FindPanel* findPanel() const;  // null: it is not open
    LayoutKeeper& layouts() { return *layout_; }
    StopButton& stopButton() { return *stop_; }
    StartAll& startAll() { return orders_->startAll(); }
    StartAgain& startAgain() { return orders_->startAgain(); }
    ControlBar& control() { return *control_; }
    bool ready() const;  // everything has come, with the values that are shown
    bool asksForPast() const { return past_.asking(); }
    void refresh();  // with the newest frame
    SystemTree& tree() { return *tree_; }
    QWidget* current() const;
    Arrangement& arrangement() { return arrangement_; }

protected:
    void paintEvent(QPaintEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;  // asks first while it is in control
    void resizeEvent(QResizeEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;  // Enter presses what has the keyboard
    bool focusNextPrevChild(bool next) override;    // in reading order
    void changeEvent(QEvent* event) override;       // another size of text

private:
    QMenu* makeMenu();
    void openTreeMenu(const std::string& path, const QPoint& at);
    void addKeys();
    void openAbnormal(bool back, std::optional<Abnormal::Kind> kind = {});
    void setTheme(int step);
    void setScale(double scale);
    void setLocalTime(bool wanted);
    void restyle();
    void arrange();
    void openFound(const Found& found, bool beside);
    void begin();  // with the keyboard
    QWidget* tabsOf(const QWidget& view) const;
    void enter();                                  // the view in front, with the keyboard
    void tell(const QString& text, bool trouble);  // among the events
    QJsonObject saved() const;
    void restore(const QJsonObject& saved);
    void choose(const std::string& path);  // in the tree
    void showStrip();                      // unless the tab of events is in front

    Session& session_;
    Commands commands_;
    ViewHost host_{commands_};
    EventModel events_;
    EventFilter eventFilter_{events_};  // one for all that show events
    StateTimes times_;
    EventPast past_{session_, events_, times_};
    Abnormal abnormal_;
    SystemTree* tree_;
    Workspace* workspace_;
    QPointer<ManualView> manual_;
    EventList* eventList_;
    QSplitter *across_, *down_;
    StatusBar* status_;
    QPointer<FindPanel> find_;
    LayoutKeeper* layout_;
    Regions regions_;
    StopButton* stop_;
    FocusEdge* edge_;
    bool refreshing_ = false;  // just now
    bool low_ = false;
    bool begins_ = true;
    QPointer<QWidget> begin_;  // has the keyboard until then
    ControlBar* control_;
    Orders* orders_;
    TopBar* bar_ = nullptr;
    Arrangement arrangement_;
    Leaving leaving_;
    QTimer timer_;
};

}  // namespace cortex::gui
