// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"
#include "cortex/core/data.hpp"
#include "cortex/core/transport.hpp"

#include <utility>

namespace cortex {
namespace {

std::uint32_t unitsOf(const DataItem& item) {
    return item.kind == Kind::String ? item.length * StringCell::size(item.capacity) : item.length;
}

// Where both layouts have the two items side by side, one copy serves them.
void addCopy(std::vector<LinkBinding::Copy>& copies, const LinkBinding::Copy& copy) {
    if (!copies.empty()) {
        LinkBinding::Copy& last = copies.back();
        if (last.kind == copy.kind && last.from + last.length == copy.from &&
            last.to + last.length == copy.to) {
            last.length += copy.length;
            return;
        }
    }
    copies.push_back(copy);
}

void addItem(LinkBinding& binding, const ItemLayout& ours, const ItemLayout& theirs) {
    addCopy(ours.item->constant ? binding.constants : binding.copies,
            {ours.item->kind, theirs.offset, ours.offset, unitsOf(*ours.item)});
}

bool sameShape(const DataItem& ours, const DataItem& theirs) {
    return ours.kind == theirs.kind && ours.length == theirs.length &&
           ours.constant == theirs.constant &&
           (ours.kind != Kind::String || ours.capacity == theirs.capacity);
}

void compareTypes(LinkBinding& binding, const Type& ours, const Type& theirs) {
    for (const Disagreement& each : compare(ours, theirs)) {
        if (each.contradiction) {
            binding.findings.error({}, "link-contradiction", {}, each.text(),
                                   "give both agents the same ontology");
        } else {
            binding.findings.warning({}, "link-difference", {}, each.text(),
                                     "what its owner says holds");
        }
    }
}

}  // namespace

LinkBinding compileLink(const TypeLayout& ours, const TypeLayout& theirs, const TypeModel& ourTypes,
                        const TypeModel& theirTypes) {
    LinkBinding binding;
    const std::string& wanted = ours.type->name;
    const Type* theirView = theirTypes.find(wanted);
    if (!theirTypes.isA(theirs.type->name, wanted) || theirView == nullptr) {
        binding.findings.error(
            {}, "link-type", {},
            "a " + wanted + " is needed, the other agent has a " + theirs.type->name,
            "relate a " + wanted + " or a child of it");
        return binding;
    }
    compareTypes(binding, *ours.type, *theirView);
    if (const Type* common = ourTypes.find(theirs.type->name);
        common != nullptr && common->name != wanted) {
        compareTypes(binding, *common, *theirs.type);
    }
    for (const ItemLayout& item : ours.items) {
        const ItemLayout* theirItem = theirs.find(item.item->name);
        if (theirItem != nullptr && sameShape(*item.item, *theirItem->item)) {
            addItem(binding, item, *theirItem);
        } else if (binding.findings.ok()) {
            binding.findings.error({}, "link-contradiction", {},
                                   wanted + "." + item.item->name + " has another shape there",
                                   "give both agents the same ontology");
        }
    }
    binding.usable = binding.findings.ok();
    return binding;
}

}  // namespace cortex
