// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTranslator>
#include <array>
#include <utility>

namespace cortex::gui {

// What `%n` stands before in texts of the window: for one, and for any other number.
inline constexpr std::array<std::pair<const char*, const char*>, 15> plurals{{
    {"%n entered value, not sent, is forgotten.", "%n entered values, not sent, are forgotten."},
    {"%n agent", "%n agents"},
    {"%n fault", "%n faults"},
    {"%n thread", "%n threads"},
    {"Compared with %n other agent", "Compared with %n other agents"},
    {"%n value", "%n values"},
    {"%n value with blanks between them", "%n values with blanks between them"},
    {"%n cycle", "%n cycles"},
    {"%n simplex is in Standby.", "%n simplexes are in Standby."},
    {"%n row", "%n rows"},
    {"%n event of %1 did not come", "%n events of %1 did not come"},
    {"%n fault or error not shown", "%n faults or errors not shown"},
    {"Set %n item", "Set %n items"},
    {"%1 in %n agent", "%1 in %n agents"},
    {"%n participant with security was found; it is seen only with a folder of its authority.",
     "%n participants with security were found; they are seen only with a folder of their "
     "authority."},
}};

// To be installed in the application: texts are written for many, and it has those for one.
class Plurals : public QTranslator {
public:
    using QTranslator::QTranslator;
    bool isEmpty() const override { return false; }
    QString translate(const char* context, const char* text, const char* remark,
                      int count) const override;
};

}  // namespace cortex::gui
