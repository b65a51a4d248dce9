// SPDX-License-Identifier: Apache-2.0
// What tasks write in the reference where nothing limits it: observations, and items of their own.
#include "determinism/reference.hpp"

#include <cmath>
#include <limits>
#include <variant>

namespace cortex::determinism {

namespace {

struct WrongValue {
    bool any = false, notFinite = false;
    double value = 0;
};

// The first that is not finite, otherwise the first that is out of the range.
WrongValue wrongIn(const Item& item, const Record& values) {
    WrongValue wrong;
    const DataItem& type = *item.type;
    for (std::size_t i = item.first; i < item.first + type.length; ++i) {
        double value = 0;
        bool outside = false;
        if (type.kind == Kind::Float) {
            value = values.floats[i];
            outside = (type.min && value < std::get<double>(*type.min)) ||
                      (type.max && value > std::get<double>(*type.max));
        } else if (type.kind == Kind::Int) {
            const std::int64_t number = values.ints[i];
            value = static_cast<double>(number);
            outside = (type.min && number < std::get<std::int64_t>(*type.min)) ||
                      (type.max && number > std::get<std::int64_t>(*type.max));
        }
        if (!std::isfinite(value)) return {true, true, value};
        if (outside && !wrong.any) wrong = {true, false, value};
    }
    return wrong;
}

// The bound that a value is beyond.
double beyond(const DataItem& type, double value) {
    const auto plain = [](auto each) { return static_cast<double>(each); };
    if (type.max && value > std::visit(plain, *type.max)) return std::visit(plain, *type.max);
    return type.min ? std::visit(plain, *type.min) : value;
}

std::string boundText(const std::optional<Number>& bound) {
    if (!bound) return "";
    const auto* whole = std::get_if<std::int64_t>(&*bound);
    return whole != nullptr ? std::to_string(*whole) : inText(std::get<double>(*bound));
}

bool isIn(const TypeModel& types, const Type& type, const char* base, const std::string& item) {
    return type.isA(base) && types.at(base).findData(item) != nullptr;
}

}  // namespace

// What is not limited: a value that is no number makes its simplex bad, one out of its range is
// told. A writer of several has values of its own, and so episodes of its own.
void Reference::checkValues(int writer, RefSimplex& checked, Record& values) {
    bool any = false, notFinite = false, outOfRange = false;
    for (const Item& item : checked.shape->items) {
        const std::string& name = item.type->name;
        const bool framework = isIn(types_, *checked.type, "Active", name) ||
                               isIn(types_, *checked.type, "Activity", name);
        if (item.type->measured || (framework && name != "progress")) continue;
        const WrongValue wrong = wrongIn(item, values);
        const auto before = wrongValues_.find({&values, item.type});
        const bool wasNoNumber = before != wrongValues_.end() && before->second;
        const bool began =
            wrong.any && (before == wrongValues_.end() || before->second != wrong.notFinite);
        any = any || wrong.any;
        notFinite = notFinite || wrong.notFinite;
        outOfRange = outOfRange || (wrong.any && !wrong.notFinite);
        if (!wrong.any)
            wrongValues_.erase({&values, item.type});
        else
            wrongValues_[{&values, item.type}] = wrong.notFinite;
        if (wasNoNumber && !wrong.notFinite)
            post(writer, Severity::Info, EventKind::Limit,
                 item.type->name + " of " + checked.path + " is a number again");
        if (!began) continue;
        std::string text = item.type->name + " of " + checked.path + " is ";
        if (wrong.notFinite)
            text += "not a number: its quality is bad";
        else
            text += inText(wrong.value, beyond(*item.type, wrong.value)) +
                    (item.type->unit.empty() ? "" : " " + item.type->unit) + ", out of its range " +
                    boundText(item.type->min) + " .. " + boundText(item.type->max);
        post(writer, Severity::Warning, EventKind::Limit, text);
    }
    if (!any) return;
    if (outOfRange) ++limits_;
    if (!notFinite || values.state.quality >= Quality::Bad) return;
    values.state.quality = Quality::Bad;
    values.state.cause = static_cast<std::uint32_t>(&checked - all_.data());
}

}  // namespace cortex::determinism
