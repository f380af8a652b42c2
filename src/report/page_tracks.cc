#include "report/page_tracks.h"

#include <cmath>

#include "core/json_pieces.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonNumber;
using core::JsonObject;

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
  return JsonObject()
      .AddText("rover", course.rover)
      .Add("start", PlaceJson({course.start.x_m, course.start.y_m}))
      .Add("goal", PlaceJson(course.goal))
      .AddNumber("goal_radius_m", course.goal_radius_m)
      .Add("waypoints", JsonList(course.waypoints, PlaceJson))
      .Add("mirror_lines_m", JsonList(course.mirror_lines_m, JsonNumber))
      .Text();
}

std::string PageTracksJson(std::span<const PageTrack> tracks) {
  return JsonList(tracks, [](const PageTrack& track) {
    return JsonObject()
        .AddInteger("trial", static_cast<std::int64_t>(track.trial))
        .Add("pieces_cm", JsonList(track.path, Piece))
        .Add("rocks_cm", Rocks(track.rocks))
        .Text();
  });
}

}  // namespace rockyard::report
