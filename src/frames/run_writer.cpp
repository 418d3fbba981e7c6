#include "frames/run_writer.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "frames/cache.h"
#include "frames/problems.h"
#include "frames/resume.h"
#include "frames/statistics_columns.h"

#include <sys/resource.h>

namespace weft {

namespace {

constexpr std::string_view k_timing_header =
    "frame,forces_s,assembly_s,solve_s,contact_broad_s,contact_proximity_s,contact_impact_s,"
    "adapt_s,matrix_update_s,step_s,step_cpu_s,verify_s,measure_s,write_s,draw_s,memory_peak_MB";

/// Greatest resident memory of the process so far, MB.
double peak_memory_mb() {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string timing_row(const FrameRecord& record, double write_seconds) {
    const StageSeconds& s = record.statistics.report.seconds;
    std::string row = std::to_string(record.statistics.frame);
    for (const double seconds :
         {s.forces, s.assembly, s.solve, s.contact_broad, s.contact_proximity, s.contact_impact,
          s.adapt, s.matrix_update, record.timing.step, record.timing.step_cpu,
          record.timing.verify, record.timing.measure, write_seconds, record.timing.draw}) {
        row += fmt::format(",{:.6f}", seconds);
    }
    return row + fmt::format(",{:.1f}", peak_memory_mb());
}

} // namespace

RunWriter::RunWriter(const RunPaths& paths)
    : paths_(paths), statistics_(paths.stats(), statistics_header(), previous_statistics_header()),
      problems_(paths.problems(), problems_header()), timing_(paths.timing(), k_timing_header) {}

void RunWriter::keep_through(int last) {
    if (const int kept = statistics_.keep_rows_through(last); kept != last) {
        fail_disk("{}: has {} of the first {} frames, which the checkpoint needs: --overwrite "
                  "starts the run again",
                  paths_.stats().string(), kept, last);
    }
    problems_.keep_rows_through(last);
    timing_.keep_rows_through(last);
    drop_checkpoints_after(paths_, last);
}

void RunWriter::write(const FrameRecord& record) {
    const Stopwatch watch;
    if (record.frame) {
        write_cache(paths_, *record.frame);
    }
    statistics_.add(statistics_row(record.statistics));
    for (const std::string& row : record.problems) {
        problems_.add(row);
    }
    timing_.add(timing_row(record, watch.seconds()));
    if (record.checkpoint) {
        finish();
        save_checkpoint(paths_, *record.checkpoint);
    } else {
        statistics_.write_if_small();
        problems_.write_if_small();
        timing_.write_if_small();
    }
    write_status(paths_.status(), record.status);
}

void RunWriter::finish() {
    statistics_.write();
    problems_.write();
    timing_.write();
}

CsvTable RunWriter::statistics() const {
    return parse_csv(statistics_.text(), paths_.stats().string());
}

} // namespace weft
