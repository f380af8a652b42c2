#include "report/page_tracks.h"

#include <cmath>

#include "report/json_members.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonNumber;

void AddCentimetres(double length_m, std::vector<std::string>& to) {
  to.push_back(std::to_string(std::llround(100.0 * length_m)));
}

std::string PlaceJson(const messages::Goal& place) {
  return JsonList(std::vector{JsonNumber(place.x_m), JsonNumber(place.y_m)});
}

// Points that round to the one before are left out.
std::string Piece(const PathPiece& piece) {
  std::vector<std::string> numbers;
  for (const math::Pose2& pose : piece) {
    AddCentimetres(pose.x_m, numbers);
    AddCentimetres(pose.y_m, numbers);
    const std::size_t n = numbers.size();
    if (n >= 4 && numbers[n - 1] == numbers[n - 3] && numbers[n - 2] == numbers[n - 4]) {
      numbers.resize(n - 2);
    }
  }
  return JsonList(numbers);
}

std::string Rocks(const std::vector<PageRock>& rocks) {
  std::vector<std::string> numbers;
  for (const PageRock& rock : rocks) {
    AddCentimetres(rock.x_m, numbers);
    AddCentimetres(rock.y_m, numbers);
    AddCentimetres(rock.radius_m, numbers);
  }
  return JsonList(numbers);
}

}  // namespace

std::string PageCourseJson(const PageCourse& course) {
  return ObjectText("rover", course.rover, "start",
                    Json{PlaceJson({course.start.x_m, course.start.y_m})}, "goal",
                    Json{PlaceJson(course.goal)}, "goal_radius_m", course.goal_radius_m,
                    "waypoints", Json{JsonList(course.waypoints, PlaceJson)}, "mirror_lines_m",
                    Json{JsonList(course.mirror_lines_m, JsonNumber)});
}

std::string PageTracksJson(std::span<const PageTrack> tracks) {
  return JsonList(tracks, [](const PageTrack& track) {
    return ObjectText("trial", track.trial, "pieces_cm", Json{JsonList(track.path, Piece)},
                      "rocks_cm", Json{Rocks(track.rocks)});
  });
}

}  // namespace rockyard::report
