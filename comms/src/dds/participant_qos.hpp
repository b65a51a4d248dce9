// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "dds/topics.hpp"

#include <string>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

// What is asked of Fast DDS.
namespace cortex::comms {

// Throws Error about options that cannot be had on this machine.
eprosima::fastdds::dds::DomainParticipantQos participantQos(const NetworkOptions& options,
                                                            const std::string& name);
// While one reader lacks a sample, all are sent heartbeats, and all answer: in a crowd more seldom,
// or it comes to nothing else. `othersOnHost`: participants in the domain.
eprosima::fastdds::dds::DataWriterQos writerQos(Qos qos, int othersOnHost = 0,
                                                bool secured = false);
eprosima::fastdds::dds::DataReaderQos readerQos(Qos qos, int othersOnHost = 0);

// For the whole process, at the first call: its log is off unless CORTEX_DDS_LOG is set, and two
// participants of one process talk as those of two would.
void setUpFastDds();

}  // namespace cortex::comms
