# rockyard as an image: docker build -t rockyard . ; docker run --rm -v "$PWD:/work" rockyard run nominal
FROM debian:12 AS build
COPY . /rockyard
WORKDIR /rockyard
RUN scripts/install_dependencies.sh build && apt-get install -y --no-install-recommends dpkg-dev file
RUN cmake --preset release -DROCKYARD_BUILD_TESTS=OFF -DROCKYARD_BUILD_BENCHMARKS=OFF \
    && cmake --build --preset release && cpack --config build/release/CPackConfig.cmake -B /package

FROM debian:12
COPY --from=build /package/*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/*.deb \
    && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["rockyard"]
