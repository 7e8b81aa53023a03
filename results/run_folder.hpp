// What programs, and the files that they leave in the folder of a run, are called: whoever writes a file and whoever
// reads it take its name from here. What the files hold is described in docs/results.md.
#pragma once

#include <array>
#include <string>

namespace skein {

namespace programs {

inline constexpr const char* kSimServer = "sim_server";
inline constexpr const char* kCommRouter = "comm_router";
inline constexpr const char* kStation = "station";
inline constexpr const char* kDoctor = "skein_doctor";  ///< of no fleet
/// Home to a whole fleet (one_process/); beside an agent's file there is such a program with its planners.
inline constexpr const char* kOneProcess = "one_process";
inline constexpr const char* kFleetSuffix = "_fleet";  ///< "uav_agent_fleet"
/// Those that every fleet has one of, in the order in which they start.
inline constexpr std::array kServers = {kSimServer, kCommRouter, kStation};
inline constexpr const char* kAgent = "uav_agent";            ///< the file; running, it is "uav_agent-jurong"
inline constexpr const char* kGroundAgent = "uav_agent-gcs";  ///< running, at the ground station

/// The program that runs a UAV's on-board software, or "gcs" at the ground station: "uav_agent-jurong".
std::string agent_program(const std::string& member);
bool is_agent(const std::string& program);
/// How the lock-step calls a program: the UAV's name, "gcs", "comm_router" or "station".
std::string member_name(const std::string& program);
/// The other way round.
std::string program_of(const std::string& member);

}  // namespace programs

namespace run_folder {

/// Where the files of a scene are, below the folder of its scenario, as `skein scene` writes it.
inline constexpr const char* kSceneFiles = "models";
// The launcher's.
inline constexpr const char* kResult = "result.json";
inline constexpr const char* kScore = "score.csv";
inline constexpr const char* kLosses = "losses.csv";
inline constexpr const char* kWork = "work.csv";
inline constexpr const char* kRecording = "recording.mcap";
inline constexpr const char* kRecordingLayout = "recording.layout.json";
inline constexpr const char* kFleetLog = "fleet.log";  ///< progress, while a debugger has the terminal
// sim_server's.
inline constexpr const char* kScene = "scene.json";
inline constexpr const char* kTrajectories = "trajectories.csv";
inline constexpr const char* kTracking = "tracking.csv";
inline constexpr const char* kDigests = "digests.csv";
inline constexpr const char* kEvents = "events.csv";
inline constexpr const char* kActivity = "activity.csv";  ///< what each UAV did, and why, as it says itself
inline constexpr const char* kByHand = "by-hand.yaml";    ///< faults, those that somebody added while it flew too
// The station's. The journal is what it takes up when it starts again.
inline constexpr const char* kCaptures = "captures.csv";
inline constexpr const char* kScoreTimeline = "score_timeline.csv";
inline constexpr const char* kJournal = "station.journal";
// The router's. The counts are what it takes up when it starts again.
inline constexpr const char* kCaptureMessages = "capture_messages.csv";
inline constexpr const char* kCounts = "comm_router.counts";
inline constexpr const char* kPlannerFiles = "planner_files";  ///< a folder: planners in Python, as they flew
// For people: of a run, or of a study, which is a folder of runs.
inline constexpr const char* kPage = "report.html";
inline constexpr const char* kFlightLog = "flight.log";  ///< what `skein run` said

/// What a program did, as it says itself: "station.report.json".
std::string report_file(const std::string& program);
/// What it said meanwhile: "station.log".
std::string log_file(const std::string& program);
/// What somebody who flew it by hand wanted of it: "hand-jurong.csv".
std::string hand_file(const std::string& uav);
/// What it knew at its end of the space around it, as OctoMap writes it: "map-jurong.bt".
std::string map_file(const std::string& uav);
/// What that was in time, if it was to be kept: "maps-jurong.mcap"; of a program that was started again,
/// "maps-jurong.2.mcap". @param life  0, 1, ...
std::string maps_file(const std::string& uav, int life);
/// Whether a file has one of these names.
bool is_maps_file(const std::string& name, const std::string& uav);
/// What it recorded, until the launcher makes one recording of it: "station.mcap"; of a program that was started again,
/// "station.2.mcap". @param life  0, 1, ...
std::string recording_part(const std::string& program, int life);

/// Whether a run, or the page of a study, writes a file of this name, or one that is being written has it for a while.
bool is_of_a_run(const std::string& name);

}  // namespace run_folder
}  // namespace skein
