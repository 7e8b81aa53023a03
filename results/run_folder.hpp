// Names of programs, and of the files that they write into a run's folder, for writers and readers of these files.
// docs/results.md describes their contents.   Threads: any.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace skein {

namespace programs {

inline constexpr const char* kSimServer = "sim_server";
inline constexpr const char* kCommRouter = "comm_router";
inline constexpr const char* kStation = "station";
inline constexpr const char* kDoctor = "skein_doctor";  ///< not part of a fleet
/// The process that runs a whole fleet (one_process/). Its file is that of the agent program, with kFleetSuffix.
inline constexpr const char* kOneProcess = "one_process";
inline constexpr const char* kFleetSuffix = "_fleet";  ///< "uav_agent_fleet"
/// The programs that every fleet has one of, in the order in which they start.
inline constexpr std::array kServers = {kSimServer, kCommRouter, kStation};
inline constexpr const char* kAgent = "uav_agent";            ///< name of the file; a running one is "uav_agent-jurong"
inline constexpr const char* kGroundAgent = "uav_agent-gcs";  ///< the running program at the ground station

/// The agent of a UAV, or of "gcs", the ground station: "uav_agent-jurong".
std::string agent_program(const std::string& member);
bool is_agent(const std::string& program);
/// The lock-step's name for a program: the UAV's name, "gcs", "comm_router" or "station".
std::string member_name(const std::string& program);
/// The inverse of member_name(). sim_server is not a member.
std::string program_of(const std::string& member);

}  // namespace programs

namespace run_folder {

/// Folder of a scene's files, below the folder of its scenario, as `skein scene` writes them.
inline constexpr const char* kSceneFiles = "models";
// Files of the launcher.
inline constexpr const char* kResult = "result.json";
inline constexpr const char* kScore = "score.csv";
inline constexpr const char* kLosses = "losses.csv";
inline constexpr const char* kWork = "work.csv";
inline constexpr const char* kRecording = "recording.mcap";
inline constexpr const char* kRecordingLayout = "recording.layout.json";
inline constexpr const char* kFleetLog = "fleet.log";  ///< progress, while a debugger has the terminal
// Files of sim_server.
inline constexpr const char* kScene = "scene.json";
inline constexpr const char* kTrajectories = "trajectories.csv";
inline constexpr const char* kTracking = "tracking.csv";
inline constexpr const char* kDigests = "digests.csv";
inline constexpr const char* kEvents = "events.csv";
inline constexpr const char* kActivity = "activity.csv";  ///< what each UAV did, and why, as its agent reported
inline constexpr const char* kByHand = "by-hand.yaml";    ///< faults, also those that a user added in flight
// Files of the station. When it is restarted, it continues from the journal.
inline constexpr const char* kCaptures = "captures.csv";
inline constexpr const char* kScoreTimeline = "score_timeline.csv";
inline constexpr const char* kJournal = "station.journal";
// Files of the router. When it is restarted, it continues from the counts.
inline constexpr const char* kCaptureMessages = "capture_messages.csv";
inline constexpr const char* kCounts = "comm_router.counts";
inline constexpr const char* kPlannerFiles = "planner_files";  ///< launcher: folder with copies of Python planners
// For users; a study's folder, which contains runs, has them, too.
inline constexpr const char* kPage = "report.html";
inline constexpr const char* kFlightLog = "flight.log";  ///< output of a flight's `skein run`

/// The report of a program: "station.report.json".
std::string report_file(const std::string& program);
/// The log of a program: "station.log".
std::string log_file(const std::string& program);
/// The commands of a user who flew the UAV by hand: "hand-jurong.csv".
std::string hand_file(const std::string& uav);
/// The UAV's map at the end of the run, in OctoMap's format: "map-jurong.bt".
std::string map_file(const std::string& uav);
/// The UAV's map over time, if the user asked for it: "maps-jurong.mcap"; "maps-jurong.2.mcap" after a restart of its
/// agent. @param life  number of restarts before: 0, 1, ...
std::string maps_file(const std::string& uav, int life);
/// Whether `name` is a maps_file() of this UAV.
bool is_maps_file(const std::string& name, const std::string& uav);
/// The name in the run's folder for a file that an agent wrote elsewhere (on another host, or under another user id):
/// its own name if that names the agent or its UAV, as the names above do; otherwise the program's name in front of it.
std::string collected_file(const std::string& program, const std::string& name);
/// The recording of one program, until the launcher joins them: "station.mcap"; "station.2.mcap" after a restart.
/// @param life  number of restarts before: 0, 1, ...
std::string recording_part(const std::string& program, int life);

/// Whether a run writes a file of this name, or a study its page. True also for the temporary name of such a file.
bool is_of_a_run(const std::string& name);

/// Whether a run's folder has a file of this name. @param run  a folder that the user named.
/// @throws InputError with the cause if this cannot be determined: there is no such folder, or it may not be searched.
bool has_file(const std::filesystem::path& run, const std::string& name);

}  // namespace run_folder
}  // namespace skein
