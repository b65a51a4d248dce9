// SPDX-License-Identifier: Apache-2.0
#include "common/role_meaning.hpp"

namespace cortex::common {

std::string_view roleMeaning(Role role) {
    switch (role) {
        case Role::Observation:
            return "data of the plant as it is";
        case Role::Modification:
            return "data of the plant as it is wished to be";
        case Role::Active:
        case Role::Descriptive:
            break;
    }
    return {};
}

}  // namespace cortex::common
