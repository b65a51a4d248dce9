// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "window/pages.hpp"
#include "window/plot_places.hpp"

#include <QJsonArray>
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <array>
#include <string>
#include <vector>

class QMenu;
class QSplitter;

namespace cortex::gui {

// All tabs of a window, in one pane or in two side by side. The first tab of the first pane always
// stays: it shows the simplex that is chosen, unless it is pinned.
class Workspace : public QWidget {
    Q_OBJECT
public:
    explicit Workspace(PageParts parts, QWidget* parent = nullptr);
    ~Workspace() override;

    void open(const std::string& path);    // where what is chosen is shown
    bool select(const std::string& path);  // whether the view in front shows it itself
    // In a pinned tab of its own, which there may be already; beside: in the pane in which the user
    // is not.
    void openTab(const std::string& path, bool beside = false);
    QWidget* openKind(const QString& kind);  // in its tab; makes one if there is none
    void openPlot(const std::vector<RecordedItem>& items);  // in the last plot, or a new one
    void newPlot(const std::vector<RecordedItem>& items);
    void openBefore(const comms::AgentEvent& fault);  // the ten seconds before it
    // Fills a menu with where these can be plotted.
    void addPlaces(QMenu& menu, const std::vector<RecordedItem>& items);
    std::vector<RecordedItem> chosenItems() const;  // of the view in front
    void openPart(const std::string& name);         // of the simplex that is shown
    void closeTab();
    void reopenTab();  // that was closed last
    void split();      // moves the tab in front to the other pane, or a copy of what follows
    void chooseTab(int number);

    QWidget* current() const;   // of the pane in which the user is
    std::string path() const;   // of the simplex in front; empty: another kind of view is
    UnitsOfView units() const;  // of the view in front
    bool shows(const QString& kind) const;
    bool wantsRoom() const;  // a view in front needs the height of the strip of events
    bool settled() const;
    Wanted wanted(const Frame& frame) const;  // by all pages that are seen
    void refresh(const std::shared_ptr<const Frame>& frame);
    void restyle();
    std::array<Pane*, 2>& panes() { return panes_; }

    QJsonObject saved() const;
    void restore(const QJsonObject& saved);

Q_SIGNALS:
    void chosen(const std::string& path);  // in a page: mark it in the tree
    void changed();                        // something that a layout keeps
    void currentChanged();

private:
    Pane& pane() const { return *panes_[active_]; }
    int place(const Pane& pane) const;  // of a new tab
    int placeOf(const Page& page, const Pane& pane) const;
    int follower(const Pane& pane) const;
    int showing(const Pane& pane, const std::string& path) const;
    void follow(const std::string& path);  // in the tab that shows what is chosen
    int addSimplex(const std::string& path, bool pinned);
    int isOpen(const Pane& pane, const QJsonObject& saved) const;
    QString freeTitle(const QString& title) const;
    std::vector<OpenPlot> plots() const;
    void plotIn(PlotView& plot, const std::vector<RecordedItem>& items, int panel);
    void addPages(Pane& pane, const QJsonArray& pages, bool all);
    void keepRecording();
    void clear();
    void addOverview();
    void connectPane(std::size_t index);
    void hideEmpty();
    void remember(std::size_t index, int tab);
    void move(std::size_t from, int tab);

    PageParts parts_;
    QSplitter* sides_;
    std::array<Pane*, 2> panes_;
    std::size_t active_ = 0;
    bool wantedRoom_ = false;
    struct Closed {
        std::size_t pane = 0;
        QJsonObject page;
    };
    std::vector<Closed> closed_;
    QTimer release_;               // ends what is recorded of the layout before
    QPointer<PlotView> lastPlot_;  // that was in front
};

}  // namespace cortex::gui
