// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/compare_model.hpp"

#include <QElapsedTimer>
#include <QJsonObject>
#include <QMenu>
#include <QWidget>

class QLineEdit;
class QPushButton;
class QTreeView;

namespace cortex::gui {

class TextLabel;

// One item of many simplexes in a table that is sorted by value, distance to a limit, or age. Its
// order is looked at every two seconds, and held while somebody works in it.
class CompareView : public QWidget {
    Q_OBJECT
public:
    explicit CompareView(QWidget* parent = nullptr);
    ~CompareView() override;

    void compare(const std::string& item, const QString& filter = {});
    void refresh(const std::shared_ptr<const Frame>& frame);
    std::vector<std::string> paths() const { return rows_->paths(); }
    QString exportTo(const QString& file) const;  // empty, or why it was not written
    const ShownUnits& units() const { return rows_->units(); }
    void setUnits(const ShownUnits& units);
    QJsonObject saved() const;
    void restore(const QJsonObject& saved);
    std::vector<RecordedItem> chosenItems() const;  // otherwise of the first rows
    QTreeView& table() { return *table_; }
    CompareModel& rows() { return *rows_; }

Q_SIGNALS:
    void opened(const std::string& path);
    void unitsChanged();
    void plotWanted(const std::vector<RecordedItem>& items);
    void placesWanted(QMenu* menu, const std::vector<RecordedItem>& items);

private:
    QWidget* makeBar();
    void search();
    void addMenu();
    void askForFile();
    bool isHeld() const;
    void growColumns();
    void tell();

    CompareModel* rows_;
    QLineEdit *item_, *filter_;
    QPushButton *plot_, *export_;
    TextLabel *count_, *note_;
    QTreeView* table_;
    QElapsedTimer ordered_;
    std::uint64_t structures_ = 0;
    QString exported_;
    bool heard_ = false;
};

}  // namespace cortex::gui
